// SPDX-License-Identifier: MIT
#include "cli/standard_output.hpp"

#include <cerrno>
#include <iostream>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace boxwood::cli {

namespace {

/// Opened the wrong way round: it takes the number, the lowest that is free, and each use of it fails.
void occupy_closed_descriptors() {
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(descriptor, F_GETFD) < 0 && errno == EBADF)
            static_cast<void>(::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY));
}

} // namespace

StandardOutput::StandardOutput() {
    occupy_closed_descriptors();
    before_ = std::cout.rdbuf(&buffer_.emplace(STDOUT_FILENO));
    if (::isatty(STDOUT_FILENO)) std::cout << std::unitbuf; // seen at once
}

StandardOutput::~StandardOutput() { std::cout.rdbuf(before_); }

std::string StandardOutput::finish() {
    std::cout.flush();
    if (buffer_->failure() == 0) return "";
    return "standard output cannot be written: " + std::generic_category().message(buffer_->failure());
}

} // namespace boxwood::cli
