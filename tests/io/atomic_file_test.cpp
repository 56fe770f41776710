// SPDX-License-Identifier: MIT
#include <csignal>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <doctest/doctest.h>

#include "boxwood/error.hpp"
#include "io/atomic_file.hpp"
#include "io/samples.hpp"

TEST_SUITE_BEGIN("io");

using boxwood::AtomicFile;
using boxwood::InputError;
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

TEST_CASE("a committed file has the bytes and leaves no temporary") {
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

TEST_CASE("an older file stays until commit and is then replaced") {
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

TEST_CASE("two writers of one name do not disturb each other") {
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

TEST_CASE("a name that cannot be written is refused at once, by its name") {
    const TemporaryFolder folder;
    const auto refused = [](const std::filesystem::path& file) {
        try {
            AtomicFile out(file);
        } catch (const InputError& error) {
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

TEST_CASE("a failed write shows at commit and leaves nothing") {
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
        } catch (const InputError& error) {
            refused = error.file == file.string();
        }
        ::_exit(refused ? 42 : 1);
    });
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 42);
    CHECK(read_bytes(file) == "old");
    CHECK(folder.entries() == 1);
}

TEST_CASE("a process that dies while it writes leaves nothing under the final name") {
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
    const int killed = in_child([&] { write_some([] { ::raise(SIGKILL); }); });
    CHECK(WIFSIGNALED(killed));
    CHECK_FALSE(std::filesystem::exists(file));
    CHECK(folder.entries() == 2); // the temporaries, which show that both children got that far
}

TEST_SUITE_END();
