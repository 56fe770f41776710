// SPDX-License-Identifier: MIT
#include "cli/progress.hpp"

#include <algorithm>
#include <iostream>

#include <unistd.h>

namespace boxwood::cli {

Progress::Progress(bool quiet, std::size_t steps) : shown_(!quiet && isatty(STDERR_FILENO)), steps_(steps) {}

Progress::~Progress() { clear(); }

void Progress::step(const std::string& what) {
    if (!shown_) return;
    constexpr std::size_t width = 24;
    const std::size_t full = std::min(width, begun_ * width / std::max<std::size_t>(steps_, 1));
    ++begun_;
    // Back to the start of the line, and clear to its end after the text.
    std::cerr << "\r[" << std::string(full, '#') << std::string(width - full, '.') << "] " << what << "\x1b[K"
              << std::flush;
}

void Progress::clear() {
    if (shown_ && begun_ > 0) std::cerr << "\r\x1b[K" << std::flush;
}

} // namespace boxwood::cli
