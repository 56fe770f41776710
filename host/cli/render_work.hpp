// SPDX-License-Identifier: MIT
// The samples of a picture one after the other: progress, checkpoints, and the way out by Ctrl-C.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "boxwood/render.hpp"
#include "cli/interrupt.hpp"
#include "cli/progress.hpp"

namespace boxwood::cli {

/// Where and when a render is saved in between.
struct Checkpoints {
    std::filesystem::path file;
    std::optional<double> seconds; ///< Between two of them; none: only when interrupted.
};

/// What was done.
struct RenderWork {
    std::uint32_t resumed = 0; ///< Samples that a checkpoint brought.
    std::uint32_t samples = 0; ///< Those and the ones taken.
    double ms = 0.0;           ///< For those taken, without the compilation of programs.
    bool interrupted = false;
    bool saved = false;    ///< A checkpoint was written on the way.
    std::string not_saved; ///< Interrupted: why no checkpoint could be written; empty when one was.
};

/// Reads the checkpoint. Throws InputError when there is none, or as Render::restore does.
void resume(Render& render, const std::filesystem::path& file);

/// Writes what is needed to go on. Returns why that failed, empty when it did not: no reason to lose the picture.
std::string save_checkpoint(const Render& render, const std::filesystem::path& file);

/// Takes samples until all are done or the user interrupts; a checkpoint of the end is left to the caller. The first one that
/// cannot be written is warned of on standard error. Waits.
RenderWork take_samples(Device& device, Render& render, std::uint32_t samples, const Checkpoints& checkpoints,
                        const InterruptGuard& guard, Progress& progress);

/// "45 s", "3 min 10 s", "2 h 5 min".
std::string duration(double seconds);

} // namespace boxwood::cli
