// SPDX-License-Identifier: MIT
// boxwood render that ends otherwise than by its last sample: signals, also while kernels are compiled, and full disks.
#include <doctest/doctest.h>

#include <string>

#include "cli/tool.hpp"

using namespace boxwood::test;

TEST_SUITE_BEGIN("cli");

namespace {

// Small: what is tested is not the light. Many samples: it must not end before it is ended.
const std::string picture = "render room.glb -o x.exr --resolution 12x8 --spp 400 --depth 2 --quiet --checkpoint 0 ";

/// Shell code that runs `command` once the first checkpoint of the tool, which takes the shell's place, is there; given
/// up after a while.
std::string after_checkpoint(const std::string& command) {
    return "(for i in $(seq 3000); do [ -e x.exr.resume ] && break; sleep 0.02; done; " + command + ") &";
}

/// A linker that sends Ctrl-C's signal to whoever called it and to itself when it links `kernel`, once, and goes on
/// where it survives that. (dash, the usual sh, would let signals through that its caller blocks.)
std::string linker(const std::string& kernel) {
    return R"(#!/bin/bash
for word; do
    if [[ $word == *.o && ! -e linked ]] && grep -q )" +
           kernel + R"( "$word"; then
        touch linked
        kill -INT $PPID $$
    fi
done
exec /usr/bin/ld "$@"
)";
}

/// The picture when nothing happens.
std::string unbroken(const Tool& tool) {
    tool.succeed("scene cornell -o room.glb");
    tool.succeed(picture);
    std::string bytes = tool.contents("x.exr");
    std::filesystem::remove(tool.file("x.exr"));
    return bytes;
}

} // namespace

TEST_CASE("render_end: a terminal that is gone ends a render as SIGTERM does, but not under nohup") {
    const Tool tool;
    const std::string whole = unbroken(tool);
    check_failure(tool.run(picture, after_checkpoint("kill -HUP $$")), 130, "--resume");
    CHECK(tool.contents("x.exr") != whole);
    tool.succeed(picture + "--resume");
    CHECK(tool.contents("x.exr") == whole);
    CHECK(tool.run(picture, "trap '' HUP; " + after_checkpoint("kill -HUP $$")).code == 0);
    CHECK(tool.contents("x.exr") == whole);
}

TEST_CASE("render_end: a picture that cannot be written in the end leaves its samples to --resume") {
    const Tool tool;
    const std::string whole = unbroken(tool);
    check_failure(tool.run(picture, after_checkpoint("mkdir x.exr")), 1,
                  "x.exr: is a folder, not a file name, but --resume goes on from x.exr.resume");
    std::filesystem::remove(tool.file("x.exr"));
    tool.succeed(picture + "--resume");
    CHECK(tool.contents("x.exr") == whole);
    check_failure(tool.run(picture + "--report x.json", after_checkpoint("mkdir x.json")), 1,
                  "x.json: is a folder, not a file name, but --resume goes on from x.exr.resume");
    CHECK(tool.contents("x.exr") == whole);
}

TEST_CASE("render_end: where a disk is full in the end, the last checkpoint stays and is named") {
    const Tool tool;
    const std::string whole = unbroken(tool);
    // A limit on the size of files stands for the disk.
    const Run full = tool.run(picture, "trap '' XFSZ; " + after_checkpoint("prlimit --pid $$ --fsize=1000"));
    CAPTURE(full.err);
    CHECK(full.code == 1);
    CHECK(full.err.find("boxwood: x.exr: cannot be written: File too large, and no checkpoint was saved: x.exr.resume: "
                        "cannot be written: File too large; --resume goes on from x.exr.resume with ") !=
          std::string::npos);
    CHECK_FALSE(std::filesystem::exists(tool.file("x.exr")));
    tool.succeed(picture + "--resume");
    CHECK(tool.contents("x.exr") == whole);
}

TEST_CASE("render_end: Ctrl-C while PoCL links a kernel is code 130") {
    // Ctrl-C reaches every process of the terminal, the linker too. PATH has one that sends it before the system's.
    for (const std::string kernel : {"radix_count", "film_add"}) { // while a tree is built, and in the first sample
        CAPTURE(kernel);
        const Tool tool;
        tool.succeed("scene cornell -o room.glb");
        tool.write("ld", linker(kernel));
        std::filesystem::permissions(tool.file("ld"), std::filesystem::perms::owner_all);
        const Run run = tool.run("render room.glb -o x.exr --resolution 4x4 --spp 2 --integrator normals --quiet",
                                 "export POCL_CACHE_DIR=\"$PWD/cache\" PATH=\"$PWD:$PATH\"; ulimit -c 0;");
        CAPTURE(run.err);
        if (!std::filesystem::exists(tool.file("linked"))) {
            MESSAGE("this device links kernels without ld");
            continue;
        }
        CHECK(run.code == 130);
        const bool in_samples = kernel == "film_add";
        CHECK(std::filesystem::exists(tool.file("x.exr.resume")) == in_samples);
    }
}

TEST_SUITE_END();
