// SPDX-License-Identifier: MIT
#include "io/atomic_file.hpp"

#include <atomic>
#include <cerrno>
#include <string>
#include <system_error>

#include <unistd.h>

#include "boxwood/error.hpp"

namespace boxwood {

namespace {

std::filesystem::path temporary_name(const std::filesystem::path& path) {
    static std::atomic<unsigned> count{0};
    std::filesystem::path temporary = path;
    temporary += '.' + std::to_string(::getpid()) + '.' + std::to_string(count++) + ".tmp";
    return temporary;
}

/// The system's reason, or the usual suspect when the stream kept none.
std::string reason(int code) { return code == 0 ? "is the disk full?" : std::generic_category().message(code); }

} // namespace

AtomicFile::AtomicFile(const std::filesystem::path& path) : path_(path), temporary_(temporary_name(path)) {
    std::error_code ignored;
    const auto status = std::filesystem::status(path_, ignored);
    if (std::filesystem::is_directory(status)) throw InputError(path_.string(), "", "is a folder, not a file name");
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
        throw InputError(path_.string(), "", "exists and is not a regular file; choose another name");
    }
    const std::filesystem::path folder = path_.parent_path();
    if (!folder.empty() && !std::filesystem::is_directory(folder, ignored)) {
        throw InputError(path_.string(), "", "the folder " + folder.string() + " does not exist; create it first");
    }
    errno = 0;
    stream_.open(temporary_, std::ios::binary | std::ios::trunc);
    if (!stream_) throw InputError(path_.string(), "", "cannot be created: " + reason(errno));
}

AtomicFile::~AtomicFile() {
    if (committed_) return;
    // A throwing exception mask set by a user of the stream must not fire here.
    try {
        stream_.exceptions(std::ios::goodbit);
        stream_.close();
    } catch (...) { // Nothing left to save: the file is about to be removed.
    }
    std::error_code ignored;
    std::filesystem::remove(temporary_, ignored);
}

void AtomicFile::commit() {
    errno = 0;
    stream_.flush();
    const int flush_code = errno;
    if (!stream_) throw InputError(path_.string(), "", "cannot be written: " + reason(flush_code));
    errno = 0;
    stream_.close();
    if (!stream_) throw InputError(path_.string(), "", "cannot be closed: " + reason(errno));
    std::error_code failure;
    std::filesystem::rename(temporary_, path_, failure);
    if (failure) throw InputError(path_.string(), "", "cannot be renamed into place: " + failure.message());
    committed_ = true;
}

} // namespace boxwood
