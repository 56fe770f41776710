// SPDX-License-Identifier: MIT
#include "cli/interrupt.hpp"

#include <cstddef>

namespace boxwood::cli {

namespace {

volatile std::sig_atomic_t raised = 0;

constexpr std::array signals = {SIGINT, SIGTERM};

/// Asked before main(): an OpenCL platform's compiler sets handlers of its own (LLVM does).
const std::array<bool, signals.size()> ignored_at_start = [] {
    std::array<bool, signals.size()> ignored = {};
    for (std::size_t i = 0; i < signals.size(); ++i) {
        struct sigaction action = {};
        sigaction(signals[i], nullptr, &action);
        ignored[i] = action.sa_handler == SIG_IGN;
    }
    return ignored;
}();

} // namespace

extern "C" {
static void remember(int signal) {
    raised = 1;
    std::signal(signal, SIG_DFL);
}
}

InterruptGuard::InterruptGuard() {
    raised = 0;
    for (std::size_t i = 0; i < signals.size(); ++i) {
        sigaction(signals[i], nullptr, &before_[i]);
        std::signal(signals[i], ignored_at_start[i] ? SIG_IGN : remember);
    }
}

InterruptGuard::~InterruptGuard() {
    for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &before_[i], nullptr);
}

bool InterruptGuard::interrupted() const { return raised != 0; }

} // namespace boxwood::cli
