// SPDX-License-Identifier: MIT
#include "io/atomic_file.hpp"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "boxwood/error.hpp"

namespace boxwood {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view ending = ".tmp";

/// NAME.PROCESS.COUNT.tmp
fs::path temporary_name(const fs::path& path) {
    static std::atomic<unsigned> count{0};
    fs::path temporary = path;
    temporary += '.' + std::to_string(::getpid()) + '.' + std::to_string(count++) + std::string(ending);
    return temporary;
}

/// The process in a temporary name of `name`; 0 when `entry` is none.
pid_t process_of(std::string_view entry, const std::string& name) {
    if (!entry.starts_with(name + '.') || !entry.ends_with(ending)) return 0;
    entry.remove_prefix(name.size() + 1);
    entry.remove_suffix(std::min(ending.size(), entry.size()));
    pid_t process = 0;
    unsigned count = 0;
    const char* const end = entry.data() + entry.size();
    const auto [dot, first] = std::from_chars(entry.data(), end, process);
    if (first != std::errc() || dot == end || *dot != '.') return 0;
    const auto [rest, second] = std::from_chars(dot + 1, end, count);
    return second == std::errc() && rest == end && process > 0 ? process : 0;
}

/// This one's number may be that of a dead process too, in a container, where they start anew: locks tell.
bool may_be_dead(pid_t process) { return process == ::getpid() || (::kill(process, 0) != 0 && errno == ESRCH); }

/// Removes the file if no process has it locked, as whoever writes it does. A process that opened it and has no lock
/// yet finds it gone when it has, by the number of links.
void remove_unlocked(const fs::path& file) {
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) return;
    struct stat status = {};
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0 && ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) &&
        status.st_nlink > 0)
        ::unlink(file.c_str());
    ::close(descriptor);
}

void remove_abandoned(const fs::path& path) {
    const fs::path folder = path.parent_path().empty() ? "." : path.parent_path();
    const std::string name = path.filename().string();
    std::error_code failure; // a folder that cannot be listed may still be written to
    for (fs::directory_iterator at(folder, failure), end; !failure && at != end; at.increment(failure)) {
        const pid_t process = process_of(at->path().filename().string(), name);
        if (process != 0 && may_be_dead(process)) remove_unlocked(at->path());
    }
}

std::string reason(int code) { return std::generic_category().message(code); }

/// Opens a new file for writing and locks it.
int create(const fs::path& file) {
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) ::flock(descriptor, LOCK_EX); // where there are no locks, nobody removes by them either
    return descriptor;
}

std::string why_not_created(const fs::path& folder, int code) {
    std::error_code ignored;
    if (code == ENOENT && !folder.empty() && !fs::exists(folder, ignored))
        return "the folder " + folder.string() + " does not exist; create it first";
    return "cannot be created: " + reason(code);
}

bool is_removed(int descriptor) {
    struct stat status = {};
    return ::fstat(descriptor, &status) == 0 && status.st_nlink == 0;
}

void check_name(const fs::path& path) {
    std::error_code ignored;
    const auto status = fs::status(path, ignored);
    if (fs::is_directory(status)) throw OutputError(path.string(), "is a folder, not a file name");
    if (fs::exists(status) && !fs::is_regular_file(status))
        throw OutputError(path.string(), "exists and is not a regular file; choose another name");
}

} // namespace

AtomicFile::AtomicFile(const fs::path& path) : path_(path) {
    check_name(path_);
    remove_abandoned(path_);
    do {
        if (descriptor_ >= 0) ::close(descriptor_);
        temporary_ = temporary_name(path_);
        descriptor_ = create(temporary_);
    } while (descriptor_ < 0 ? errno == EEXIST : is_removed(descriptor_));
    if (descriptor_ < 0) throw OutputError(path_.string(), why_not_created(path_.parent_path(), errno));
    stream_.rdbuf(&buffer_.emplace(descriptor_));
}

AtomicFile::~AtomicFile() {
    if (descriptor_ < 0) return;
    ::unlink(temporary_.c_str());
    ::close(descriptor_);
}

void AtomicFile::commit() {
    stream_.flush();
    if (!stream_) throw OutputError(path_.string(), "cannot be written: " + reason(buffer_->failure()));
    // What some file systems say at the end only. A copy is closed, as the lock stays until the name is the final one.
    const int copy = ::dup(descriptor_);
    if (copy >= 0 && ::close(copy) != 0) throw OutputError(path_.string(), "cannot be written: " + reason(errno));
    std::error_code failure;
    fs::rename(temporary_, path_, failure);
    if (failure) throw OutputError(path_.string(), "cannot be renamed into place: " + failure.message());
    ::close(std::exchange(descriptor_, -1));
}

} // namespace boxwood
