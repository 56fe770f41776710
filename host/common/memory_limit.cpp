// SPDX-License-Identifier: MIT
#include "common/memory_limit.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

#include <sys/resource.h>
#include <unistd.h>

namespace boxwood {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

/// What a limit of the process leaves beside `used` bytes.
std::uint64_t left_of(decltype(RLIMIT_AS) resource, std::uint64_t used) {
    rlimit limit = {};
    if (::getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unlimited;
    return limit.rlim_cur - std::min<std::uint64_t>(used, limit.rlim_cur);
}

/// The least of the limits in files of this name in `group`, a path below `top`, and in the folders around it up to
/// `top`. A container may see the files of its own group at the top, below which the path of outside is not there.
std::uint64_t group_limit(const fs::path& top, const fs::path& group, const char* name) {
    std::uint64_t least = unlimited;
    for (fs::path folder = top / group.relative_path();; folder = folder.parent_path()) {
        std::uint64_t limit = 0;
        if (std::ifstream(folder / name) >> limit) least = std::min(least, limit); // "max" is no number
        if (folder == top || !folder.has_relative_path()) return least;
    }
}

std::uint64_t cgroup_limit(const fs::path& root) {
    const fs::path groups = root / "sys/fs/cgroup";
    std::uint64_t least = unlimited;
    // HIERARCHY:CONTROLLERS:PATH, with no controllers in version 2.
    std::ifstream stream(root / "proc/self/cgroup");
    for (std::string line; std::getline(stream, line);) {
        const std::size_t first = line.find(':'), second = line.find(':', first + 1);
        if (first == std::string::npos || second == std::string::npos) continue;
        const std::string controllers = ',' + line.substr(first + 1, second - first - 1) + ',';
        const fs::path path = line.substr(second + 1);
        if (controllers == ",,")
            least = std::min(least, group_limit(groups, path, "memory.max"));
        else if (controllers.find(",memory,") != std::string::npos)
            least = std::min(least, group_limit(groups / "memory", path, "memory.limit_in_bytes"));
    }
    return least;
}

} // namespace

std::uint64_t process_limit(const fs::path& root) {
    // Pages: all, resident, shared, text, none, data with stacks.
    std::uint64_t pages[6] = {};
    std::ifstream stream(root / "proc/self/statm");
    for (std::uint64_t& number : pages) stream >> number;
    const auto page = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
    return std::min(left_of(RLIMIT_AS, pages[0] * page), left_of(RLIMIT_DATA, pages[5] * page));
}

std::uint64_t memory_limit(const fs::path& root) { return std::min(process_limit(root), cgroup_limit(root)); }

std::uint64_t usable_by_device(std::uint64_t limit) {
    constexpr std::uint64_t least_left = std::uint64_t{256} << 20;
    return limit - std::min(limit, std::max(limit / 4, least_left));
}

} // namespace boxwood
