// SPDX-License-Identifier: MIT
#include "cli/render_work.hpp"

#include <chrono>
#include <cmath>
#include <fstream>
#include <iostream>
#include <new>
#include <utility>

#include "boxwood/error.hpp"
#include "io/atomic_file.hpp"

namespace boxwood::cli {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::vector<std::byte> file_bytes(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw InputError(file.string(), "", "cannot be opened");
    std::error_code failure;
    const auto size = std::filesystem::file_size(file, failure);
    std::vector<std::byte> bytes(failure ? 0 : size);
    if (failure || !stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size())))
        throw InputError(file.string(), "", "cannot be read");
    return bytes;
}

} // namespace

std::string duration(double seconds) {
    const auto whole = static_cast<long>(std::min(std::ceil(seconds), 1e9));
    if (whole < 60) return std::to_string(whole) + " s";
    if (whole < 3600) return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
    return std::to_string(whole / 3600) + " h " + std::to_string(whole % 3600 / 60) + " min";
}

void resume(Render& render, const std::filesystem::path& file) { render.restore(file_bytes(file), file.string()); }

std::string save_checkpoint(const Render& render, const std::filesystem::path& file) {
    try {
        const std::vector<std::byte> bytes = render.state();
        AtomicFile out(file);
        out.stream().write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        out.commit();
        return "";
    } catch (const OutputError& error) {
        return error.what();
    } catch (const std::bad_alloc&) {
        return "out of host memory";
    }
}

Kept keep_samples(const Render& render, const RenderWork& work, const std::filesystem::path& file) {
    const std::string failure = save_checkpoint(render, file);
    const std::string resume_words = "--resume goes on from " + file.string();
    if (failure.empty()) return {true, resume_words};
    std::error_code ignored;
    const bool older = work.saved > 0 && std::filesystem::is_regular_file(file, ignored);
    return {false, "no checkpoint was saved: " + failure +
                       (older ? "; " + resume_words + " with " + std::to_string(work.saved) + " samples" : "")};
}

RenderWork take_samples(Device& device, Render& render, std::uint32_t samples, const Checkpoints& checkpoints,
                        const InterruptGuard& guard, Progress& progress) {
    RenderWork work{render.samples(), render.samples(), 0.0, render.samples(), false};
    bool warned = false;
    const auto start = Clock::now();
    auto saved = start;
    const double compiled_before = device.compile_ms();
    const auto seconds = [&] { return seconds_since(start) - 1e-3 * (device.compile_ms() - compiled_before); };
    progress.skip(work.resumed);
    while (!render.done() && !guard.interrupted()) {
        const std::uint32_t taken = work.samples - work.resumed;
        const std::string left =
            taken == 0 ? "" : ", " + duration(seconds() / taken * (samples - work.samples)) + " left";
        progress.step("sample " + std::to_string(work.samples + 1) + " of " + std::to_string(samples) + left);
        render.advance();
        device.finish();
        work.samples = render.samples();
        if (checkpoints.seconds && !render.done() && seconds_since(saved) >= *checkpoints.seconds) {
            const std::string failure = save_checkpoint(render, checkpoints.file);
            if (failure.empty()) work.saved = work.samples;
            if (!failure.empty() && !std::exchange(warned, true)) {
                progress.clear();
                std::cerr << "boxwood: warning: no checkpoint was saved: " << failure << '\n';
            }
            saved = Clock::now();
        }
    }
    work.ms = 1e3 * seconds();
    work.interrupted = !render.done();
    return work;
}

} // namespace boxwood::cli
