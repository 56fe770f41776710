// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <atomic>
#include <csignal>
#include <thread>

namespace boxwood::cli {

/// The signals that ask a program to end: Ctrl-C, SIGTERM, and SIGHUP when its terminal is gone.
inline constexpr std::array interrupts = {SIGINT, SIGTERM, SIGHUP};

/// While it lives, this thread gets no interrupts, nor do the threads and programs that it starts. Ctrl-C goes to the
/// linkers of a device too, and PoCL ends the process when one of them dies of it.
class InterruptsBlocked {
public:
    InterruptsBlocked();
    ~InterruptsBlocked();
    InterruptsBlocked(const InterruptsBlocked&) = delete;
    InterruptsBlocked& operator=(const InterruptsBlocked&) = delete;

private:
    sigset_t before_;
};

/// While it lives, interrupts are remembered instead of ending the program; a second one ends it. A signal that is
/// ignored, as under nohup, stays so. Afterwards all is as it was before. One at a time, in the main thread.
class InterruptGuard {
public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    bool interrupted() const;

private:
    std::array<struct sigaction, interrupts.size()> before_;
    const InterruptsBlocked blocked_; ///< For the linkers that this thread's kernels need.
    std::atomic_flag done_;
    std::thread listener_; ///< Gets them.
};

} // namespace boxwood::cli
