// SPDX-License-Identifier: MIT
#include "runtime/pocl.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <vector>

#include <sched.h>
#include <unistd.h>

namespace boxwood {

namespace {

namespace fs = std::filesystem;

/// The threads that PoCL starts: as many as asked for, by the name of today or that of before version 6, else one for
/// each CPU.
std::size_t pocl_threads() {
    for (const char* name : {"POCL_CPU_MAX_CU_COUNT", "POCL_MAX_PTHREAD_COUNT"}) {
        const char* value = std::getenv(name);
        const std::string_view text = value ? value : "";
        std::size_t count = 0;
        std::from_chars(text.data(), text.data() + text.size(), count);
        if (count > 0) return count;
    }
    return static_cast<std::size_t>(std::max(::sysconf(_SC_NPROCESSORS_ONLN), 1L));
}

/// Where PoCL keeps kernels (lib/CL/pocl_cache.c).
fs::path pocl_cache_folder() {
    if (const char* folder = std::getenv("POCL_CACHE_DIR")) return folder;
    const char* kept = std::getenv("POCL_KERNEL_CACHE");
    const fs::path name = kept && std::string_view(kept) == "0" ? "pocl/uncached" : "pocl/kcache";
    if (const char* caches = std::getenv("XDG_CACHE_HOME"); caches && *caches) return caches / name;
    if (const char* home = std::getenv("HOME")) return fs::path(home) / ".cache" / name;
    return "/tmp" / name;
}

/// Writes a file of a page and removes it. Returns the errno of what failed, 0 when nothing did.
int try_to_write(const fs::path& folder) {
    std::string name = (folder / "boxwood-XXXXXX").string();
    const int descriptor = ::mkstemp(name.data());
    if (descriptor < 0) return errno;
    const std::vector<char> page(4096);
    errno = ENOSPC; // for less than the page
    const int code = ::write(descriptor, page.data(), page.size()) == static_cast<ssize_t>(page.size()) ? 0 : errno;
    ::close(descriptor);
    ::unlink(name.c_str());
    return code;
}

} // namespace

bool may_run_on_first_cpus(std::size_t count) {
    // The kernel takes no smaller set than it has CPUs.
    constexpr std::size_t most = 1 << 16;
    if (count > most) return false;
    std::vector<cpu_set_t> allowed(most / CPU_SETSIZE);
    const std::size_t bytes = allowed.size() * sizeof(cpu_set_t);
    if (::sched_getaffinity(0, bytes, allowed.data()) != 0) return false;
    for (std::size_t cpu = 0; cpu < count; ++cpu)
        if (!CPU_ISSET_S(cpu, bytes, allowed.data())) return false;
    return true;
}

void pin_pocl_threads() {
    // Unpinned, they are woken on one core and share it for the first milliseconds, which halves the speed of short
    // kernels.
    if (may_run_on_first_cpus(pocl_threads())) ::setenv("POCL_AFFINITY", "1", 0);
}

std::string pocl_cache_fault() {
    const fs::path folder = pocl_cache_folder();
    std::error_code failure;
    fs::create_directories(folder, failure);
    if (!failure) failure.assign(try_to_write(folder), std::generic_category());
    if (!failure) return "";
    return "PoCL's folder for compiled kernels, " + folder.string() + ", cannot be written: " + failure.message() +
           "; set POCL_CACHE_DIR to one that can";
}

} // namespace boxwood
