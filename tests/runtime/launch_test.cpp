// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <string>

#include "boxwood/error.hpp"
#include "runtime/device_state.hpp"
#include "runtime/kernel_text.hpp"
#include "runtime/launch.hpp"
#include "runtime/pocl.hpp"
#include "support.hpp"
#include "tuning.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("runtime");

namespace {

constexpr const char* counting = "kernel void count(global uint* out, uint first) {\n"
                                 "    out[get_global_id(0)] = first + (uint)get_global_id(0) + STEP;\n"
                                 "}\n";
constexpr const char* broken = "// one\n#include \"launch_test/part.h\"\nkernel void f(global uint* out) {\n"
                               "    out[0] = not_declared;\n}\n";

KernelRef count_kernel(const char* step) { return {"launch_test/count.cl", "count", {{"STEP", step}}}; }

void add_texts() {
    add_kernels({{"launch_test/count.cl", counting},
                 {"launch_test/broken.cl", broken},
                 {"launch_test/part.h", "#define PART 1\n\n"},
                 {"launch_test/missing.cl", "#include \"launch_test/nowhere.h\"\n"}});
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

} // namespace

TEST_CASE("launch: runs over whole groups with its arguments and macros, or not at all") {
    add_texts();
    Device& device = test_device();
    const TuningScope scope({4, 16, 1});
    Guarded<std::uint32_t> out(device, 8); // 5 work-items are rounded up to two groups
    launch(device, count_kernel("100"), "count", 5, out.view(), std::uint32_t(10));
    CHECK(out.values() == std::vector<std::uint32_t>{110, 111, 112, 113, 114, 115, 116, 117});
    launch(device, count_kernel("200"), "count", 4, out.view(), std::uint32_t(10));
    CHECK(out.values()[0] == 210);
    CHECK(out.values()[4] == 114);
    launch(device, count_kernel("300"), "count", 0, out.view(), std::uint32_t(10));
    CHECK(out.values()[0] == 210);
    CHECK(out.intact());
}

TEST_CASE("launch: a wrong number or size of arguments, or no such kernel, is a DeviceError") {
    add_texts();
    Device& device = test_device();
    Guarded<std::uint32_t> out(device, 64);
    try {
        launch(device, count_kernel("1"), "count", 1, out.view());
        FAIL("did not throw");
    } catch (const DeviceError& error) {
        CHECK(error.kernel == "count");
        CHECK(has(error.what(), "takes 2 arguments, got 1"));
    }
    CHECK_THROWS_AS(launch(device, count_kernel("1"), "count", 1, out.view(), 1u, 2u), DeviceError);
    CHECK_THROWS_AS(launch(device, count_kernel("1"), "count", 1, out.view(), std::uint64_t(1)), DeviceError);
    device.state().checks_arguments = false; // the driver itself notices a wrong size
    CHECK_THROWS_AS(launch(device, count_kernel("1"), "count", 1, out.view(), std::uint64_t(1)), DeviceError);
    device.state().checks_arguments = true;
    const KernelRef nameless{"launch_test/count.cl", "no_such_kernel", {{"STEP", "1"}}};
    CHECK_THROWS_AS(launch(device, nameless, "count", 1, out.view(), 1u), DeviceError);
}

TEST_CASE("launch: PoCL reads few declarations of built-in functions for an embedded kernel, all for others") {
    add_texts();
    add_kernels({{"launch_test/few.cl", "kernel void f(global float* out) { out[0] = sqrt(out[0]); }\n"},
                 {"launch_test/every.cl", "kernel void f(global float* out) { out[0] = sinpi(out[0]); }\n"},
                 {"launch_test/brought.cl", "#include \"runtime/inserted.h\"\n"}});
    Device& device = test_device();
    if (!is_pocl(device.info().platform)) return;
    const auto reads_few = [&](const char* file, const char* source) {
        const cl::Kernel& kernel = device.state().kernel(file, "f", "-cl-std=" + device.info().language, source);
        const auto program = kernel.getInfo<CL_KERNEL_PROGRAM>();
        return has(program.getBuildInfo<CL_PROGRAM_BUILD_OPTIONS>(device.state().device), pocl_without_builtins);
    };
    CHECK(reads_few("launch_test/few.cl", ""));
    CHECK_FALSE(reads_few("launch_test/every.cl", "")); // calls another function
    CHECK_FALSE(reads_few("launch_test/brought.cl", "kernel void f(global float* out) { out[0] = sqrt(out[0]); }\n"));
}

TEST_CASE("launch: a program that does not compile says file, line, device, options, log and text") {
    add_texts();
    Device& device = test_device();
    try {
        compile(device, {"launch_test/broken.cl", "f", {{"SOME_MACRO", "17"}}});
        FAIL("did not throw");
    } catch (const ProgramError& error) {
        CHECK(error.file == "launch_test/broken.cl");
        CHECK(error.device == device.info().name);
        CHECK(has(error.options, "-DSOME_MACRO=17"));
        CHECK(has(error.options, "-cl-std=" + device.info().language));
        CHECK(has(error.options, "-cl-fp32-correctly-rounded-divide-sqrt") ==
              device.info().correctly_rounded_divide_sqrt);
        CHECK(has(error.log, "not_declared"));
        // As in the file, not in the text with its includes; Oclgrind's log has its own names for files.
        if (device.info().platform != "Oclgrind") CHECK(has(error.log, "launch_test/broken.cl:4"));
        for (const std::string& part : {error.file, error.device, error.options, std::string("out[0] = not_declared")})
            CHECK(has(error.what(), part));
    }
}

TEST_CASE("launch: a missing file is a ProgramError that names it") {
    add_texts();
    try {
        compile(test_device(), {"launch_test/missing.cl", "f"});
        FAIL("did not throw");
    } catch (const ProgramError& error) {
        CHECK(error.file == "launch_test/missing.cl");
        CHECK(has(error.what(), "launch_test/nowhere.h"));
    }
    CHECK_THROWS_AS(compile(test_device(), {"launch_test/nothing.cl", "f"}), ProgramError);
}
