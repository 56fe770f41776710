// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <vector>

#include <glm/glm.hpp>

#include "bounds/lanes_of.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

TEST_CASE("tangents: orthonormal and right-handed around any direction, also next to the poles") {
    std::vector<std::array<float, 3>> directions;
    const auto add = [&](const glm::dvec3& v) {
        const glm::vec3 n = glm::normalize(v);
        directions.push_back({n.x, n.y, n.z});
    };
    for (const double z : {0.0, -0.0, 1.0, -1.0, 0.5, -0.5})
        for (const double off : {0.0, 1e-42, 1e-30, 1e-7, 1e-4, 1e-3, 1.0})
            for (const double turn : {0.0, 0.1, 0.25, 0.6, 0.75})
                if (z != 0.0 || off != 0.0)
                    add({off * std::cos(6.2831853 * turn), off * std::sin(6.2831853 * turn), z});
    Random random(test_seed());
    for (int i = 0; i < (small_sizes() ? 50 : 5000); ++i)
        add({random.uniform(-1, 1) + 0.001, random.uniform(-1, 1), random.uniform(-1, 1)});
    const auto frames = in_lanes("render/tangents_test.cl", "tangents_test",
                                 std::vector<std::array<float, 9>>(directions.size()), directions);
    double worst = 0.0;
    for (const std::array<float, 9>& f : frames) {
        const glm::dmat3 m(f[0], f[1], f[2], f[3], f[4], f[5], f[6], f[7], f[8]);
        const glm::dmat3 square = glm::transpose(m) * m;
        for (int k = 0; k < 9; ++k) {
            const double off = std::abs(square[k / 3][k % 3] - (k % 4 == 0 ? 1 : 0));
            worst = std::isfinite(off) ? std::max(worst, off) : off;
        }
        CHECK(glm::determinant(m) > 0.0);
    }
    // The direction's length is off by a roundoff and a half; each component of the others has five roundings.
    CHECK(worst <= 6 * 0x1p-24);
    MESSAGE("worst entry of F F^T - I in roundoffs: " << worst * 0x1p24);
}
