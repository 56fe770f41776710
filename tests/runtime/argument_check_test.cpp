// SPDX-License-Identifier: MIT
// The device under test compares every launch's arguments with the compiled kernel: here that it would notice.
#include <doctest/doctest.h>

#include <string>

#include "boxwood/error.hpp"
#include "runtime/kernel_text.hpp"
#include "runtime/launch.hpp"
#include "shared/ray.h"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("runtime");

namespace {

constexpr const char* text = "#include \"shared/ray.h\"\n"
                             "kernel void take(global const Ray* rays, global uint* out, uint count, ulong seed) {\n"
                             "    if (get_global_id(0) == 0) out[0] = rays[0].t_max > 0.0f ? count + (uint)seed : 0;\n"
                             "}\n";

template <class... Arguments>
std::string complaint(Arguments&&... arguments) {
    add_kernels({{"argument_check_test/take.cl", text}});
    try {
        launch(test_device(), {"argument_check_test/take.cl", "take"}, "take", 1, arguments...);
        return "";
    } catch (const DeviceError& error) {
        return error.what();
    }
}

bool has(const std::string& whole, const std::string& part) { return whole.find(part) != std::string::npos; }

} // namespace

TEST_CASE("argument_check: arguments of other types than the kernel's, and const ones that it writes, are refused") {
    Device& device = test_device();
    const Buffer<Ray> rays = upload(device, std::vector<Ray>{{{}, 0.0f, {}, 1.0f}}, "rays");
    Buffer<std::uint32_t> out = upload(device, std::vector<std::uint32_t>{7}, "out");
    const Buffer<std::uint32_t>& read_only = out;
    Buffer<float> floats = upload(device, std::vector<float>{7.0f}, "floats");
    CHECK(complaint(rays, out, 3u, std::uint64_t{4}) == "");
    CHECK(download(device, out)[0] == 7);
    CHECK(has(complaint(floats, out, 3u, std::uint64_t{4}), "takes Ray*, got float*"));
    CHECK(has(complaint(rays, floats, 3u, std::uint64_t{4}), "takes uint*, got float*"));
    CHECK(has(complaint(rays, read_only, 3u, std::uint64_t{4}), "may write to uint*"));
    CHECK(has(complaint(rays, out, 3.0f, std::uint64_t{4}), "takes uint, got float"));
    CHECK(has(complaint(rays, out, 3u, double{4}), "takes ulong, got double"));
    CHECK(has(complaint(out, rays, 3u, std::uint64_t{4}), "argument 0"));
}
