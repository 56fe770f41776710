// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "boxwood/profile.hpp"
#include "runtime/kernel_text.hpp"
#include "runtime/launch.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("runtime");

namespace {

void run(const char* label) {
    Guarded<std::uint32_t> out(test_device(), 256);
    launch(test_device(), {"profile_test.cl", "nothing"}, label, 1, out.view());
}

} // namespace

TEST_CASE("profile: launches count under the innermost stage, by label, in order of the first") {
    add_kernels({{"profile_test.cl", "kernel void nothing(global uint* out) { out[get_global_id(0)] = 1; }\n"}});
    Device& device = test_device();
    device.take_profile();
    run("a");
    {
        const Stage outer(device, "outer");
        run("a");
        {
            const Stage inner(device, "inner");
            run("b");
            run("b");
        }
        run("a");
        run("c");
    }
    run("a");
    const Profile profile = device.take_profile();
    REQUIRE(profile.passes.size() == 4);
    const char* stages[] = {"", "outer", "inner", "outer"};
    const char* labels[] = {"a", "a", "b", "c"};
    const std::uint64_t launches[] = {2, 2, 2, 1};
    double sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        CAPTURE(i);
        CHECK(profile.passes[i].stage == stages[i]);
        CHECK(profile.passes[i].label == labels[i]);
        CHECK(profile.passes[i].launches == launches[i]);
        CHECK(profile.passes[i].ms > 0.0);
        sum += profile.passes[i].ms;
    }
    CHECK(profile.total_ms() == doctest::Approx(sum));
    CHECK(profile.stage_ms("outer") == doctest::Approx(profile.passes[1].ms + profile.passes[3].ms));
    CHECK(profile.stage_ms("none of these") == 0.0);
    CHECK(device.take_profile().passes.empty());
}
