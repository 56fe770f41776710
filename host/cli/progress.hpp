// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

namespace boxwood::cli {

/// A bar of the steps of a command, on standard error when that is a terminal; nothing otherwise or when quiet.
class Progress {
public:
    Progress(bool quiet, std::size_t steps);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Begins the next step.
    void step(const std::string& what);
    /// Counts steps that need not be done.
    void skip(std::size_t steps) { begun_ += steps; }
    /// Takes the bar away, before something is printed.
    void clear();

private:
    bool shown_;
    std::size_t steps_;
    std::size_t begun_ = 0;
};

} // namespace boxwood::cli
