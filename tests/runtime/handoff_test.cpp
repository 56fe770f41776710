// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "runtime/kernel_text.hpp"
#include "runtime/launch.hpp"
#include "support.hpp"
#include "tuning.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("runtime");

namespace {

void check_pairs(const KernelRef& kernel) {
    Device& device = test_device();
    const std::uint32_t pairs = small_sizes() ? 500 : 100000;
    Buffer<std::uint32_t> left = make_scratch<std::uint32_t>(device, 2 * pairs, "left");
    Buffer<std::uint32_t> places = make_scratch<std::uint32_t>(device, pairs, "places");
    Guarded<std::uint32_t> sums(device, pairs), seconds(device, pairs);
    fill(device, places, 0);
    fill(device, seconds.view(), 0);
    launch(device, kernel, "handoff test", 2 * pairs, left, places, sums.view(), seconds.view(), pairs);
    std::size_t wrong = 0;
    const auto sum = sums.values(), taken = seconds.values(), counts = download(device, places);
    for (std::uint32_t p = 0; p < pairs; ++p)
        if (sum[p] != 3 * (2 * p + pairs) + 2 || taken[p] != 1 || counts[p] != 2) ++wrong;
    CHECK(wrong == 0);
    CHECK(sums.intact());
    CHECK(seconds.intact());
}

} // namespace

TEST_CASE("handoff: exactly one of two takes over, and sees what the other wrote") {
    for (const Tuning& tuning : tunings()) {
        CAPTURE(tuning.group_size);
        const TuningScope scope(tuning);
        check_pairs({"runtime/handoff_test.cl", "handoff_test"});
    }
}

TEST_CASE("handoff: the path of OpenCL C 1.2") {
    // The dialect is the device's, so what the header asks about it is replaced.
    std::string text = resolve_kernel_text("runtime/handoff_test.cl");
    const std::string test = "__OPENCL_C_VERSION__ >= 300";
    const std::size_t place = text.find(test);
    REQUIRE(place != std::string::npos);
    text.replace(place, test.size(), "0");
    static const std::string kept = text;
    add_kernels({{"runtime/handoff_12.cl", kept.c_str()}});
    check_pairs({"runtime/handoff_12.cl", "handoff_test"});
}
