// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "runtime/launch.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("runtime");

TEST_CASE("lanes: the device's instruction and its portable twin agree on every mask") {
    for (const char* portable : {"0", "1"}) {
        CAPTURE(portable);
        Guarded<std::uint32_t> out(test_device(), 4 * 256);
        launch(test_device(), {"runtime/lanes_test.cl", "lanes_test", {{"PORTABLE_LANES", portable}}}, "lanes test",
               256, out.view());
        const auto values = out.values();
        for (std::uint32_t mask = 0; mask < 256; ++mask) {
            CHECK(values[4 * mask + 0] == mask);
            CHECK(values[4 * mask + 1] == mask);
            CHECK(values[4 * mask + 2] == (mask & 15));
            CHECK(values[4 * mask + 3] == (mask & 15));
        }
        CHECK(out.intact());
    }
}
