// SPDX-License-Identifier: MIT
#pragma once

#include <streambuf>
#include <vector>

namespace boxwood {

/// Buffers what is written to a file descriptor, which it does not own, and keeps the system's reason of the first
/// write that failed, which std::filebuf forgets. Seekable where the descriptor is. After a failure nothing more is
/// written.
class OutputBuffer : public std::streambuf {
public:
    explicit OutputBuffer(int descriptor);

    /// The errno of the first failure, 0 without one.
    int failure() const { return failure_; }

protected:
    int_type overflow(int_type next) override;
    int sync() override;
    pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode which) override;
    pos_type seekpos(pos_type position, std::ios_base::openmode which) override;

private:
    int descriptor_;
    int failure_ = 0;
    std::vector<char> buffer_;
};

} // namespace boxwood
