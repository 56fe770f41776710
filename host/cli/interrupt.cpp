// SPDX-License-Identifier: MIT
#include "cli/interrupt.hpp"

#include <csignal>

namespace boxwood::cli {

namespace {

volatile std::sig_atomic_t raised = 0;

} // namespace

extern "C" {
static void remember(int signal) {
    raised = 1;
    std::signal(signal, SIG_DFL);
}
}

InterruptGuard::InterruptGuard() {
    raised = 0;
    std::signal(SIGINT, remember);
    std::signal(SIGTERM, remember);
}

InterruptGuard::~InterruptGuard() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

bool InterruptGuard::interrupted() const { return raised != 0; }

} // namespace boxwood::cli
