// SPDX-License-Identifier: MIT
#include "boxwood/rounding.hpp"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "boxwood/procedural.hpp"

TEST_SUITE_BEGIN("scene");

using namespace boxwood;

namespace {

const glm::vec3 earth_centred(1335838.536, -4659713.479, 4131346.164);

glm::mat4 moved(glm::vec3 by) {
    glm::mat4 transform(1.0f);
    transform[3] = glm::vec4(by, 1.0f);
    return transform;
}

/// A sphere of radius 1, placed.
Scene placed_sphere(const glm::mat4& transform) {
    Scene scene = make_procedural("sphere", {.triangles = 500});
    scene.instances[0].transform = transform;
    return scene;
}

/// What flatten() moves the vertices of a scene of one instance by, along an axis, in long double.
double moved_by(const Scene& scene) {
    const std::vector<glm::vec3>& from = scene.meshes[0].positions;
    const std::vector<glm::vec3> to = flatten(scene).meshes[0].positions;
    const glm::mat4& m = scene.instances[0].transform;
    long double most = 0.0L;
    for (std::size_t i = 0; i < from.size(); ++i)
        for (int axis = 0; axis < 3; ++axis) {
            long double exact = m[3][axis];
            for (int k = 0; k < 3; ++k) exact += static_cast<long double>(m[k][axis]) * from[i][k];
            most = std::max(most, std::abs(exact - to[i][axis]));
        }
    return static_cast<double>(most);
}

} // namespace

TEST_CASE("rounding: what flatten moves vertices by, and the size of the box") {
    // Units in the last place: 0.5 from 2^22 on, 0.25 below.
    const Scene far = placed_sphere(moved(earth_centred));
    CHECK(rounding_of(far, 0).distance == moved_by(far));
    CHECK(rounding_of(far, 0).distance > 0.2);
    CHECK(rounding_of(far, 0).distance <= 0.25);
    CHECK(rounding_of(far, 0).size == 2.0);
    // Rows (0.36 0.48 -0.8), (-0.8 0.6 0), (0.48 0.64 0.6) by 3: the box of the box's corners.
    const glm::mat4 turned{{1.08f, -2.4f, 1.44f, 0}, {1.44f, 1.8f, 1.92f, 0}, {-2.4f, 0, 1.8f, 0}, {1e5f, -2e3f, 7, 1}};
    const Scene askew = placed_sphere(turned);
    CHECK(rounding_of(askew, 0).distance == doctest::Approx(moved_by(askew)).epsilon(1e-6));
    CHECK(rounding_of(askew, 0).size == doctest::Approx(2.0 * (1.44 + 1.92 + 1.8)));
}

TEST_CASE("rounding: none where vertices are in their place, or come there exactly") {
    Scene baked = placed_sphere(glm::mat4(1.0f));
    for (glm::vec3& position : baked.meshes[0].positions) position += earth_centred;
    CHECK(rounding_of(baked, 0).distance == 0.0);
    CHECK_FALSE(worst_rounding(baked));

    const glm::mat4 exchanged{{0, 0, -0x1p20f, 0}, {0x1p20f, 0, 0, 0}, {0, 0x1p20f, 0, 0}, {0, 0, 0, 1}};
    CHECK(rounding_of(placed_sphere(exchanged), 0).distance == 0.0);

    Scene whole = placed_sphere(moved({3e6f, -5e6f, 4e6f}));
    for (glm::vec3& position : whole.meshes[0].positions) position = glm::round(64.0f * position);
    CHECK(rounding_of(whole, 0).distance == 0.0);
    CHECK_FALSE(worst_rounding(whole));

    // A quarter turn as it comes out of a quaternion.
    glm::mat4 quarter(1.0f);
    quarter[1] = glm::vec4(0, 0x1p-52f, -1, 0);
    quarter[2] = glm::vec4(0, 1, 0x1p-52f, 0);
    baked.instances[0].transform = quarter;
    CHECK(rounding_of(baked, 0).distance > 0.0);
    CHECK(rounding_of(baked, 0).distance < 1e-8);
    CHECK_FALSE(worst_rounding(baked));
}

TEST_CASE("rounding: a mesh of size 1 passes the limit 2048 units from the origin, at any scale") {
    for (const float scale : {0x1p-40f, 1.0f, 0x1p40f}) {
        CAPTURE(scale);
        const auto at = [scale](float x) {
            glm::mat4 transform = moved({scale * x, 0, 0});
            for (int k = 0; k < 3; ++k) transform[k][k] = 0.5f * scale;
            return placed_sphere(transform);
        };
        CHECK_FALSE(worst_rounding(at(2047.0f)));
        REQUIRE(worst_rounding(at(2049.0f)));
        CHECK(worst_rounding(at(2049.0f))->fraction() > rounding_limit);
        CHECK(worst_rounding(at(2049.0f))->fraction() <= 2.0 * rounding_limit);
        CHECK(rounding_of(at(2049.0f), 0).fraction() == worst_rounding(at(2049.0f))->fraction());
    }
}

TEST_CASE("rounding: the worst instance, the first of equals, named with its mesh") {
    CHECK_FALSE(worst_rounding(Scene{}));
    Scene scene = placed_sphere(glm::mat4(1.0f));
    scene.meshes[0].name = "ball";
    scene.instances.push_back({"", 0, moved({4e3f, 0, 0})});
    scene.instances.push_back({"", 0, moved({0, 3e5f, 0})});
    scene.instances.push_back({"", 0, moved({3e5f, 0, 0})});
    const Rounding worst = worst_rounding(scene).value();
    CHECK(worst.instance == 2);
    CHECK(rounding_of(scene, 1).fraction() < worst.fraction());
    CHECK(rounding_of(scene, 3).fraction() == worst.fraction());
    CHECK(words(worst, scene) == "instances[2] of meshes[0] \"ball\" by up to 0.015 units, 0.75 % of its size");
    scene.meshes[0].name.clear();
    CHECK(words(worst, scene).starts_with("instances[2] of meshes[0] by "));

    // No ray meets what has no extent.
    for (glm::vec3& position : scene.meshes[0].positions) position = glm::vec3(0.1f);
    CHECK(rounding_of(scene, 2).distance > 0.0);
    CHECK(rounding_of(scene, 2).fraction() == 0.0);
    CHECK_FALSE(worst_rounding(scene));
}

TEST_CASE("rounding: what double would lose too is counted, however small the mesh") {
    for (const float size : {1e-10f, 1e-20f, 1e-30f, 1e-35f}) {
        CAPTURE(size);
        glm::mat4 transform = moved({1, 2, 3});
        for (int k = 0; k < 3; ++k) transform[k][k] = size;
        const Scene scene = placed_sphere(transform);
        CHECK(rounding_of(scene, 0).fraction() == doctest::Approx(0.5));
        REQUIRE(worst_rounding(scene));
    }
}

TEST_CASE("rounding: a scene collapses when each of its instances does, at any scale") {
    CHECK_FALSE(collapses(Scene{}));
    for (const float scale : {0x1p-40f, 1.0f, 0x1p40f}) {
        CAPTURE(scale);
        const auto at = [scale](float size, float x) {
            glm::mat4 transform = moved({scale * x, 0, 0});
            for (int k = 0; k < 3; ++k) transform[k][k] = 0.5f * size * scale;
            return placed_sphere(transform);
        };
        CHECK_FALSE(collapses(at(1.0f, 0.0f)));
        CHECK_FALSE(collapses(at(1e-6f, 1.0f)));
        CHECK_FALSE(collapses(at(1e-20f, 0.0f)));
        CHECK(collapses(at(1e-8f, 1.0f)));
        CHECK(collapses(at(1e-20f, 1.0f)));
        Scene two = at(1e-20f, 1.0f);
        two.instances.push_back(two.instances[0]);
        two.instances[1].transform[3] = glm::vec4(-scale, 0, 0, 1);
        CHECK(collapses(two));
        two.instances[1].transform[0] = glm::vec4(scale, 0, 0, 0);
        CHECK_FALSE(collapses(two));
    }
}

TEST_SUITE_END();
