// SPDX-License-Identifier: MIT
#pragma once

namespace boxwood::cli {

/// While it lives, Ctrl-C (SIGINT) and SIGTERM are remembered instead of ending the program; a second one ends it. One at a time.
class InterruptGuard {
public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    bool interrupted() const;
};

} // namespace boxwood::cli
