// SPDX-License-Identifier: MIT
#include "cli/interrupt.hpp"

#include <cstddef>

namespace boxwood::cli {

namespace {

volatile std::sig_atomic_t raised = 0;

/// Asked before main(): an OpenCL platform's compiler sets handlers of its own (LLVM does).
const std::array<bool, interrupts.size()> ignored_at_start = [] {
    std::array<bool, interrupts.size()> ignored = {};
    for (std::size_t i = 0; i < interrupts.size(); ++i) {
        struct sigaction action = {};
        sigaction(interrupts[i], nullptr, &action);
        ignored[i] = action.sa_handler == SIG_IGN;
    }
    return ignored;
}();

sigset_t all_interrupts() {
    sigset_t set;
    sigemptyset(&set);
    for (const int signal : interrupts) sigaddset(&set, signal);
    return set;
}

} // namespace

extern "C" {
static void remember(int signal) {
    raised = 1;
    std::signal(signal, SIG_DFL);
}
}

InterruptGuard::InterruptGuard() {
    raised = 0;
    for (std::size_t i = 0; i < interrupts.size(); ++i) {
        sigaction(interrupts[i], nullptr, &before_[i]);
        std::signal(interrupts[i], ignored_at_start[i] ? SIG_IGN : remember);
    }
    listener_ = std::thread([this] {
        const sigset_t set = all_interrupts();
        pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
        done_.wait(false);
    });
}

InterruptGuard::~InterruptGuard() {
    done_.test_and_set();
    done_.notify_all();
    listener_.join();
    for (std::size_t i = 0; i < interrupts.size(); ++i) sigaction(interrupts[i], &before_[i], nullptr);
}

bool InterruptGuard::interrupted() const { return raised != 0; }

InterruptsBlocked::InterruptsBlocked() {
    const sigset_t set = all_interrupts();
    pthread_sigmask(SIG_BLOCK, &set, &before_);
}

InterruptsBlocked::~InterruptsBlocked() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

} // namespace boxwood::cli
