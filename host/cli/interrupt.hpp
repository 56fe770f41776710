// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <csignal>

namespace boxwood::cli {

/// While it lives, Ctrl-C (SIGINT) and SIGTERM are remembered instead of ending the program; a second one ends it. A signal that is
/// ignored, as under nohup, stays so. Afterwards all is as it was before. One at a time.
class InterruptGuard {
public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    bool interrupted() const;

private:
    std::array<struct sigaction, 2> before_;
};

} // namespace boxwood::cli
