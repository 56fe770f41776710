// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "runtime/launch.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("volumes");

TEST_CASE("turn_steps: cosines and sines of the angles, correctly rounded") {
    Guarded<float> steps(test_device(), 32);
    launch(test_device(), {"volumes/turn_steps_test.cl", "turn_steps_test"}, "turn steps", 1, steps.view());
    const std::vector<float> found = steps.values();
    const int coarse[8] = {-4, -3, -2, -1, 0, 1, 2, 3}, fine[8] = {-4, -3, -2, -1, 1, 2, 3, 4};
    for (std::size_t k = 0; k < 8; ++k) {
        const double angles[2] = {std::numbers::pi * coarse[k] / 16, std::numbers::pi * fine[k] / 128};
        for (std::size_t table = 0; table < 2; ++table) {
            CHECK(found[16 * table + k] == float(std::cos(angles[table])));
            CHECK(found[16 * table + 8 + k] == float(std::sin(angles[table])));
        }
    }
    CHECK(steps.intact());
}
