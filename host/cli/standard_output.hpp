// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <streambuf>
#include <string>

#include "io/output_buffer.hpp"

namespace boxwood::cli {

/// Standard output as a file that may fail: while it lives, std::cout goes through it. One, before anything is opened:
/// where the caller closed a standard descriptor, it gives that number to nothing that can be used, so that no file
/// gets it, and what is printed with it.
class StandardOutput {
public:
    StandardOutput();
    ~StandardOutput();
    StandardOutput(const StandardOutput&) = delete;
    StandardOutput& operator=(const StandardOutput&) = delete;

    /// Writes what is still buffered. Returns why something printed did not arrive, empty when all did: no script
    /// should take a cut text for the whole.
    std::string finish();

private:
    std::optional<OutputBuffer> buffer_;
    std::streambuf* before_;
};

} // namespace boxwood::cli
