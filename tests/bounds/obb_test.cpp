// SPDX-License-Identifier: MIT
#include "boxwood/obb.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include <glm/gtc/matrix_transform.hpp>

#include "boxwood/error.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("bounds");

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

Obb aligned_box(const glm::vec3& center, const glm::vec3& half) {
    return {{center.x, center.y, center.z}, {half.x, half.y, half.z}, {1, 0, 0, 0, 1, 0, 0, 0, 1}, 0};
}

glm::dmat4 random_affine(Random& random, double size) {
    glm::dmat4 m(1.0);
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 3; ++r) m[c][r] = size * random.uniform(-1, 1);
    return m;
}

glm::dvec3 apply(const glm::dmat4& m, const glm::dvec3& p) { return glm::dvec3(m * glm::dvec4(p, 1)); }

glm::dvec3 corner(int k) { return {k & 1 ? 0.5 : -0.5, k & 2 ? 0.5 : -0.5, k & 4 ? 0.5 : -0.5}; }

/// Twelve triangles' worth of corners: the area and volume of the parallelepiped `m` from its corners alone.
double volume_of_corners(const glm::dmat4& m) {
    const glm::dvec3 o = apply(m, corner(0));
    return std::abs(glm::dot(apply(m, corner(1)) - o, glm::cross(apply(m, corner(2)) - o, apply(m, corner(4)) - o)));
}
double area_of_corners(const glm::dmat4& m) {
    const glm::dvec3 o = apply(m, corner(0));
    const glm::dvec3 a = apply(m, corner(1)) - o, b = apply(m, corner(2)) - o, c = apply(m, corner(4)) - o;
    return 2 * (glm::length(glm::cross(a, b)) + glm::length(glm::cross(b, c)) + glm::length(glm::cross(c, a)));
}

} // namespace

TEST_CASE("obb: matrix, volume and area of a box by hand") {
    const Obb box = aligned_box({1, 2, 3}, {0.5f, 1, 2});
    const glm::dmat4 m = to_matrix(box);
    CHECK(m == glm::translate(glm::dmat4(1), glm::dvec3(1, 2, 3)) * glm::scale(glm::dmat4(1), glm::dvec3(1, 2, 4)));
    CHECK(volume(box) == 8);
    CHECK(surface_area(box) == 2 * (2 + 8 + 4));
    CHECK(contains(box, {1.5, 3, 5}));
    CHECK_FALSE(contains(box, {std::nextafter(1.5, 2.0), 3, 5}));
    CHECK_FALSE(contains(box, {std::nan(""), 3, 5}));
}

TEST_CASE("obb: the empty box and the box of a point") {
    const Obb empty = aligned_box({0, 0, 0}, {-infinity, -infinity, -infinity});
    CHECK(volume(empty) == 0);
    CHECK(surface_area(empty) == 0);
    CHECK_FALSE(contains(empty, {0, 0, 0}));
    CHECK_THROWS_AS(to_matrix(empty), InputError);

    const Obb point = aligned_box({7, 8, 9}, {0, 0, 0});
    CHECK(volume(point) == 0);
    CHECK(contains(point, {7, 8, 9}));
    CHECK(contains(to_obb(to_matrix(point)), {7, 8, 9}));
    CHECK(volume(to_obb(to_matrix(point))) == 0);
}

TEST_CASE("obb: the box of a matrix holds its cube, hardly more, at every size") {
    Random random(3);
    // Up to the last of the float range whose box is in it, and where the products of three sizes leave that of double.
    for (const double size : {1.0, 1e-30, 1e18, 1e-44, 1e37}) {
        CAPTURE(size);
        for (int n = 0; n < 200; ++n) {
            const glm::dmat4 m = random_affine(random, size);
            const Obb box = to_obb(m);
            for (int k = 0; k < 8; ++k) {
                // The double-precision corner is itself rounded: pull it in by that much.
                const glm::dvec3 p = apply(m, corner(k) * (1 - 0x1p-45));
                CHECK(contains(box, p));
            }
            if (size < 1e-40) continue; // widths of a few denormals: no digits to compare
            // A roundoff in each of three widths, in a width those of axis and centre: relative to the largest entry,
            // over the smallest width. Skip slivers, which only the corners can judge.
            const double exact = volume_of_corners(m), relative = exact / (size * size * size);
            if (relative < 0.05) continue;
            CHECK(std::abs(volume(box) / exact - 1) <= 64 * 0x1p-24 / relative);
            CHECK(std::abs(surface_area(box) / area_of_corners(m) - 1) <= 64 * 0x1p-24 / relative);
        }
    }
}

TEST_CASE("obb: a box updated by an affine map holds its mapped points, also a flat one") {
    Random random(4);
    for (const glm::vec3& half : {glm::vec3(1, 2, 3), glm::vec3(1, 2, 0), glm::vec3(0, 2, 0), glm::vec3(0, 0, 0)}) {
        CAPTURE(half.x + half.y + half.z);
        const Obb box = aligned_box({1, -2, 0.5f}, half);
        for (int n = 0; n < 50; ++n) {
            const glm::dmat4 m = random_affine(random, 10);
            const Obb moved = to_obb(m * to_matrix(box));
            for (int k = 0; k < 8; ++k) {
                const glm::dvec3 p = glm::dvec3(1, -2, 0.5) + 2.0 * glm::dvec3(half) * corner(k);
                const glm::dvec3 q = apply(m, p), c = glm::dvec3(m * glm::dvec4(1, -2, 0.5, 1));
                CHECK(contains(moved, c + (q - c) * (1 - 0x1p-45)));
            }
            // A flat box stays flat but for the rounding of its place and axes.
            const double flat = 64 * 0x1p-24 * 60;
            const int zero = (half.x == 0) + (half.y == 0) + (half.z == 0);
            int thin = 0;
            for (const float h : moved.extent) thin += h <= flat;
            CHECK(thin >= zero);
        }
    }
}

TEST_CASE("obb: singular and non-finite matrices are refused") {
    glm::dmat4 dependent(1.0);
    dependent[1] = 2.0 * dependent[0];
    CHECK_THROWS_AS(to_obb(dependent), InputError);
    glm::dmat4 bad(1.0);
    bad[2][1] = std::nan("");
    CHECK_THROWS_AS(to_obb(bad), InputError);
    bad[2][1] = infinity;
    CHECK_THROWS_AS(to_obb(bad), InputError);
    glm::dmat4 far(1.0);
    far[3][0] = 1e39;
    CHECK_THROWS_AS(to_obb(far), InputError);
    CHECK_THROWS_AS(to_obb(glm::dmat4(1e39)), InputError);
}
