// SPDX-License-Identifier: MIT
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <doctest/doctest.h>

#include "boxwood/error.hpp"
#include "io/atomic_file.hpp"
#include "io/samples.hpp"

TEST_SUITE_BEGIN("io");

using boxwood::AtomicFile;
using boxwood::OutputError;
using boxwood::test::read_bytes;
using boxwood::test::TemporaryFolder;
using boxwood::test::write_bytes;

namespace {

/// Runs `work` in a child process, which must end by itself; returns its wait status.
template <class Work>
int in_child(Work&& work) {
    const pid_t child = ::fork();
    if (child == 0) {
        work();
        ::_exit(0);
    }
    int status = -1;
    ::waitpid(child, &status, 0);
    return status;
}

} // namespace

TEST_CASE("atomic_file: a committed file has the bytes and leaves no temporary") {
    const TemporaryFolder folder;
    const auto file = folder.path() / "out.bin";
    const std::string bytes("a\0b\r\n", 5);
    AtomicFile out(file);
    out.stream() << bytes;
    CHECK_FALSE(std::filesystem::exists(file));
    out.commit();
    CHECK(read_bytes(file) == bytes);
    CHECK(folder.entries() == 1);
}

TEST_CASE("atomic_file: an older file stays until commit and is then replaced") {
    const TemporaryFolder folder;
    const auto file = folder.path() / "out.bin";
    write_bytes(file, "old");
    {
        AtomicFile abandoned(file);
        abandoned.stream() << "never seen" << std::flush;
        CHECK(read_bytes(file) == "old");
    }
    CHECK(read_bytes(file) == "old");
    CHECK(folder.entries() == 1);
    AtomicFile out(file);
    out.stream() << "new";
    out.commit();
    CHECK(read_bytes(file) == "new");
    CHECK(folder.entries() == 1);
}

TEST_CASE("atomic_file: two writers of one name do not disturb each other") {
    const TemporaryFolder folder;
    const auto file = folder.path() / "out.bin";
    AtomicFile first(file);
    AtomicFile second(file);
    first.stream() << "first";
    second.stream() << "second";
    first.commit();
    CHECK(read_bytes(file) == "first");
    second.commit();
    CHECK(read_bytes(file) == "second");
}

TEST_CASE("atomic_file: a name that cannot be written is refused at once, by its name") {
    const TemporaryFolder folder;
    const auto refused = [](const std::filesystem::path& file) {
        try {
            AtomicFile out(file);
        } catch (const OutputError& error) {
            return error.file == file.string();
        }
        return false;
    };
    CHECK(refused(folder.path() / "missing" / "out.bin"));
    CHECK(refused(folder.path()));
    CHECK(refused("/dev/null"));                           // a rename would replace the device
    CHECK(refused(folder.path() / std::string(300, 'x'))); // longer than any file system's names
    write_bytes(folder.path() / "file", "");
    CHECK(refused(folder.path() / "file" / "out.bin"));
    if (::geteuid() != 0) { // root may write anywhere
        std::filesystem::permissions(folder.path(),
                                     std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
        CHECK(refused(folder.path() / "out.bin"));
        std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
    }
}

TEST_CASE("atomic_file: a failed write shows at commit and leaves nothing") {
    const TemporaryFolder folder;
    const auto file = folder.path() / "out.bin";
    write_bytes(file, "old");
    // A limit on file size stands for a full disk; only a child process can take it on and die with it.
    const int status = in_child([&] {
        ::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{1000, 1000};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        bool refused = false;
        try {
            AtomicFile out(file);
            out.stream() << std::string(100000, 'x');
            out.commit();
        } catch (const OutputError& error) {
            refused = error.file == file.string() && std::string(error.what()).ends_with(std::strerror(EFBIG));
        }
        ::_exit(refused ? 42 : 1);
    });
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 42);
    CHECK(read_bytes(file) == "old");
    CHECK(folder.entries() == 1);
}

TEST_CASE("atomic_file: a process that dies while it writes leaves nothing under the final name") {
    const TemporaryFolder folder;
    const auto file = folder.path() / "out.bin";
    const auto write_some = [&](auto&& die) {
        AtomicFile out(file);
        out.stream() << std::string(100000, 'x') << std::flush;
        die();
    };
    const int exited = in_child([&] { write_some([] { ::_exit(7); }); });
    CHECK(WIFEXITED(exited));
    CHECK(WEXITSTATUS(exited) == 7);
    CHECK(folder.entries() == 1); // the temporary, which shows that the child got that far
    const int killed = in_child([&] { write_some([] { ::raise(SIGKILL); }); });
    CHECK(WIFSIGNALED(killed));
    CHECK_FALSE(std::filesystem::exists(file));
    CHECK(folder.entries() == 1); // its own: that of the first is removed
}

TEST_CASE(
    "atomic_file: temporaries of dead processes are removed by the next file of that name, and no other file is") {
    const TemporaryFolder folder;
    const auto file = folder.path() / "out.bin";
    // The process of a child that has ended: no other gets its number so soon.
    pid_t dead = 0;
    int channel[2];
    REQUIRE(::pipe(channel) == 0);
    in_child([&] {
        AtomicFile out(file);
        out.stream() << "half" << std::flush;
        const pid_t self = ::getpid();
        ::_exit(::write(channel[1], &self, sizeof self) == sizeof self ? 0 : 1);
    });
    REQUIRE(::read(channel[0], &dead, sizeof dead) == sizeof dead);
    const std::string process = std::to_string(dead), self = std::to_string(::getpid());
    REQUIRE(folder.entries() == 1);
    const auto add = [&](const std::string& name) { write_bytes(folder.path() / name, "of another"); };
    const std::vector<std::string> others = {
        "out.bin.1.0.tmp", // of a living process
        "out.bin." + process + ".tmp",
        "out.bin." + process + ".0.tmp.bak",
        "out.bin." + process + ".x.tmp",
        "out.bin.-" + process + ".0.tmp",
        "out.bin.0.0.tmp",
        "out.bin..tmp",
        "out.bin.tmp",
        "xout.bin." + process + ".0.tmp",
        "out.bin2." + process + ".0.tmp",
    };
    for (const std::string& name : others) add(name);
    std::filesystem::create_symlink(folder.path() / "out.bin.tmp", folder.path() / ("out.bin." + process + ".77.tmp"));
    std::filesystem::create_directory(folder.path() / ("out.bin." + process + ".78.tmp"));
    add("out.bin." + process + ".79.tmp");      // left, as that of the child
    add("out.bin." + self + ".4000000000.tmp"); // left by one that had this process's number, in another container
    {
        // One that is still written, by its lock: the process may be of another container, and seem dead.
        const auto locked = folder.path() / ("out.bin." + process + ".80.tmp");
        std::ofstream(locked) << "living";
        const int lock = ::open(locked.c_str(), O_WRONLY | O_CLOEXEC);
        REQUIRE(::flock(lock, LOCK_EX) == 0);
        AtomicFile first(file); // not those of this process that are still written either
        AtomicFile second(file);
        CHECK(folder.entries() == others.size() + 5);
        ::close(lock);
        second.commit();
        first.commit();
    }
    AtomicFile(file).commit();
    CHECK(folder.entries() == others.size() + 3); // with the link, the folder and the file itself
    for (const std::string& name : others) CHECK(std::filesystem::exists(folder.path() / name));
    ::close(channel[0]);
    ::close(channel[1]);
}

TEST_SUITE_END();
