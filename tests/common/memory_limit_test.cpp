// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "boxwood/device.hpp"
#include "common/memory_limit.hpp"

using namespace boxwood;

TEST_SUITE_BEGIN("common");

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

/// A root of a file system with what a process in control groups sees.
class Root {
public:
    Root() : path_(fs::temp_directory_path() / ("boxwood-limits-" + std::to_string(::getpid()))) {}
    ~Root() { fs::remove_all(path_); }
    Root(const Root&) = delete;
    Root& operator=(const Root&) = delete;

    void write(const fs::path& file, const std::string& text) const {
        fs::create_directories((path_ / file).parent_path());
        std::ofstream(path_ / file) << text << '\n';
    }
    std::uint64_t limit() const { return memory_limit(path_); }

private:
    fs::path path_;
};

} // namespace

TEST_CASE("memory_limit: the least of the control groups around the process, version 2") {
    const Root root;
    CHECK(root.limit() == unlimited); // no files at all
    root.write("proc/self/cgroup", "0::/user/session");
    CHECK(root.limit() == unlimited); // none of the groups visible
    root.write("sys/fs/cgroup/user/session/memory.max", "max");
    root.write("sys/fs/cgroup/user/memory.max", "3000000000");
    CHECK(root.limit() == 3000000000u);
    root.write("sys/fs/cgroup/user/session/memory.max", "4000000000");
    CHECK(root.limit() == 3000000000u);
    root.write("sys/fs/cgroup/user/session/memory.max", "1000000000");
    CHECK(root.limit() == 1000000000u);
    root.write("sys/fs/cgroup/memory.max", "500000000"); // a container's own group, at the top
    CHECK(root.limit() == 500000000u);
    root.write("proc/self/cgroup", "0::/");
    CHECK(root.limit() == 500000000u);
    root.write("proc/self/cgroup", "0::/../../elsewhere"); // a process that was moved out of its container's view
    CHECK(root.limit() == 500000000u);
    root.write("proc/self/cgroup", "nonsense");
    CHECK(root.limit() == unlimited);
}

TEST_CASE("memory_limit: that of the memory controller, version 1, also beside version 2") {
    const Root root;
    root.write("proc/self/cgroup",
               "5:cpu,cpuacct:/docker/a\n4:hugetlb,memory:/docker/a\n3:memory_of_others:/b\n0::/docker/a");
    root.write("sys/fs/cgroup/memory/docker/a/memory.limit_in_bytes", "9223372036854771712"); // none
    CHECK(root.limit() == 9223372036854771712u);
    root.write("sys/fs/cgroup/memory/b/memory.limit_in_bytes", "1");
    root.write("sys/fs/cgroup/cpu/docker/a/memory.limit_in_bytes", "1");
    root.write("sys/fs/cgroup/memory/docker/memory.limit_in_bytes", "2000000000");
    CHECK(root.limit() == 2000000000u);
    root.write("sys/fs/cgroup/memory/memory.limit_in_bytes", "1000000000");
    CHECK(root.limit() == 1000000000u);
    root.write("sys/fs/cgroup/memory.max", "800000000");
    CHECK(root.limit() == 800000000u);
}

TEST_CASE("memory_limit: what limits of the process leave beside what it has") {
    const Root root;
    const auto page = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
    root.write("proc/self/statm", "1000 500 300 20 0 200 0");
    const auto limit_with = [&](decltype(RLIMIT_AS) resource, std::uint64_t pages) {
        // Only a child process can take a limit on and be rid of it.
        int channel[2];
        REQUIRE(::pipe(channel) == 0);
        const pid_t child = ::fork();
        if (child == 0) {
            const rlimit limit{pages * page, RLIM_INFINITY};
            ::setrlimit(resource, &limit);
            const std::uint64_t found = root.limit();
            ::_exit(::write(channel[1], &found, sizeof found) == sizeof found ? 0 : 1);
        }
        std::uint64_t found = 0;
        CHECK(::read(channel[0], &found, sizeof found) == sizeof found);
        ::waitpid(child, nullptr, 0);
        for (const int end : channel) ::close(end);
        return found;
    };
    // Far above what the test itself has mapped.
    const std::uint64_t many = (std::uint64_t{1} << 46) / page;
    CHECK(limit_with(RLIMIT_AS, many) == (many - 1000) * page);
    CHECK(limit_with(RLIMIT_DATA, many) == (many - 200) * page);
    root.write("proc/self/statm", std::to_string(2 * many) + " 0 0 0 0 0 0"); // more than is allowed
    CHECK(limit_with(RLIMIT_AS, many) == 0);
}

TEST_CASE("memory_limit: a device may use what compilers and the host's arrays leave") {
    constexpr std::uint64_t mebibyte = 1 << 20;
    CHECK(usable_by_device(0) == 0);
    CHECK(usable_by_device(256 * mebibyte) == 0);
    CHECK(usable_by_device(1000 * mebibyte) == 744 * mebibyte);
    CHECK(usable_by_device(4000 * mebibyte) == 3000 * mebibyte);
    for (const DeviceInfo& info : list_devices()) {
        CHECK(info.largest_buffer_bytes <= info.global_bytes);
        if (info.cpu) CHECK(info.global_bytes <= memory_limit());
    }
}

TEST_SUITE_END();
