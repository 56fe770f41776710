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
    std::uint32_t saved = 0;   ///< Those of the last checkpoint that was read or written; 0 without one.
    bool interrupted = false;
};

/// What there is for --resume of samples whose picture is not whole or not written.
struct Kept {
    bool all = false;
    std::string words; ///< "--resume goes on from ...", with the reason before it unless it has all.
};

/// Reads the checkpoint. Throws InputError when there is none, or as Render::restore does.
void resume(Render& render, const std::filesystem::path& file);

/// Writes what is needed to go on. Returns why that failed, empty when it did not: no reason to lose the picture.
std::string save_checkpoint(const Render& render, const std::filesystem::path& file);

/// The same in the end; where it fails, an older checkpoint stays.
Kept keep_samples(const Render& render, const RenderWork& work, const std::filesystem::path& file);

/// Takes samples until all are done or the user interrupts; a checkpoint of the end is left to the caller. The first
/// one that cannot be written is warned of on standard error. Waits.
RenderWork take_samples(Device& device, Render& render, std::uint32_t samples, const Checkpoints& checkpoints,
                        const InterruptGuard& guard, Progress& progress);

/// "45 s", "3 min 10 s", "2 h 5 min".
std::string duration(double seconds);

} // namespace boxwood::cli
