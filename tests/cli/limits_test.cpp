// SPDX-License-Identifier: MIT
// The tool on a CPU device where the system leaves it little: memory, CPUs, a place for compiled kernels.
#include <doctest/doctest.h>

#include <string>

#include "cli/tool.hpp"

// AddressSanitizer reserves more address space than any limit leaves. GCC tells by a macro, Clang by a feature.
#ifdef __has_feature
#if __has_feature(address_sanitizer)
#define SANITIZED_ADDRESSES
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define SANITIZED_ADDRESSES
#endif

using namespace boxwood::test;

TEST_SUITE_BEGIN("cli");

TEST_CASE("limits: a folder for compiled kernels that cannot be written is named") {
    const Tool tool;
    tool.succeed("scene sphere -o sphere.glb");
    // Below a file, where not even root can make a folder: PoCL then has no device.
    const Run none = tool.run("devices", "export POCL_CACHE_DIR=sphere.glb/cache;");
    check_failure(none, 4, "sphere.glb/cache, cannot be written: Not a directory; set POCL_CACHE_DIR");
    CHECK(none.err.find("no OpenCL device") == std::string::npos);
    check_failure(tool.run("devices", "unset POCL_CACHE_DIR; export XDG_CACHE_HOME=sphere.glb;"), 4,
                  "sphere.glb/pocl/kcache, cannot be written: Not a directory");
    // A folder without files: PoCL then has a device, and compiles nothing.
    check_failure(tool.run("build sphere.glb -o x.bxw", "export POCL_CACHE_DIR=/proc/self;"), 1,
                  "/proc/self, cannot be written: ");
}

TEST_CASE("limits: more threads than CPUs, and CPUs that the process may not run on") {
    const Tool tool;
    CHECK(tool.run("devices", "unset POCL_AFFINITY; export POCL_MAX_PTHREAD_COUNT=70;").code == 0);
    CHECK(tool.run("devices", "unset POCL_AFFINITY; export POCL_MAX_PTHREAD_COUNT=1;").code == 0);
    CHECK(tool.run("devices", "unset POCL_AFFINITY; taskset -p -c 0 $$ >/dev/null;").code == 0);
}

#ifndef SANITIZED_ADDRESSES
TEST_CASE("limits: a limited address space is the memory of a CPU device") {
    const Tool tool;
    tool.succeed("scene random --triangles 1000000 -o random.glb");
    tool.succeed("build random.glb -o x.bxw"); // compiles
    bool refused = false, done = false;
    for (const int mebibytes : {300, 400, 500, 600, 700, 800, 900, 1000, 1200, 2000}) {
        CAPTURE(mebibytes);
        const std::string limit = "ulimit -c 0; ulimit -v " + std::to_string(mebibytes << 10) + ";";
        const Run run = tool.run("build random.glb -o x.bxw", "export POCL_MAX_PTHREAD_COUNT=2; " + limit);
        CAPTURE(run.err);
        if (run.code == 4)
            check_failure(run, 4, "ulimit -v"); // too little for the driver itself
        else if (run.code != 0)
            check_failure(run, 1, " available");
        refused |= run.code == 1;
        done |= run.code == 0;
    }
    CHECK(refused);
    CHECK(done);
}
#endif

TEST_SUITE_END();
