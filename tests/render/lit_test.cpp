// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "boxwood/build.hpp"
#include "boxwood/render.hpp"
#include "path_scenes.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

namespace {

bool lit(const Scene& scene) { return has_light(test_device(), scene, build(test_device(), scene)); }

/// A block on a floor, with a square of `radiance` on its front.
Scene with_sign(float side, float radiance) {
    Scene scene;
    add_floor(scene, matt(glm::vec3(0.5f)));
    add_quad(scene, {-0.5f, 0, 0}, {1, 0, 0}, {0, 1, 0}, matt(glm::vec3(0.8f)));
    add_quad(scene, {-0.5f * side, 0.5f, 0.01f}, {side, 0, 0}, {0, side, 0}, lamp(glm::vec3(radiance)));
    return scene;
}

} // namespace

TEST_CASE("lit: lamps light a room, signs and screws no scene") {
    CHECK_FALSE(lit(Scene{}));
    CHECK(lit(cornell_scene())); // open to the front
    CHECK(lit(make_procedural("cornell")));
    for (const float k : {-60.0f, 60.0f}) CHECK(lit(scaled(cornell_scene(), std::exp2(k))));
    for (const float side : {0.01f, 0.5f}) CHECK_FALSE(lit(with_sign(side, 1.0f)));

    // A lamp over the floor, down or up; both sides are half of each.
    Scene scene;
    add_floor(scene, matt(glm::vec3(0.5f)));
    CHECK_FALSE(lit(scene));
    Scene below = scene, above = scene;
    add_quad(below, {-0.5f, 1, -0.5f}, {1, 0, 0}, {0, 0, 1}, lamp(glm::vec3(3.0f))); // faces down
    add_quad(above, {-0.5f, 1, 0.5f}, {1, 0, 0}, {0, 0, -1}, lamp(glm::vec3(3.0f))); // faces up
    CHECK(lit(below));
    CHECK_FALSE(lit(above));
    below.materials.back().double_sided = true;
    CHECK_FALSE(lit(below)); // 0.47 of it meets the floor
    // Mirrored by its instance, it faces down as before: the front goes with the vertices in object space.
    below.materials.back().double_sided = false;
    below.instances.back().transform[0][0] = -1.0f;
    CHECK(lit(below));
    // The screw in its hole: all that it gives meets the wall, and is nothing beside a sky.
    below.materials.back().emission = glm::vec3(0x1p-10f);
    CHECK_FALSE(lit(below));

    Light sun;
    sun.kind = LightKind::directional;
    above.lights = {sun};
    CHECK(lit(above));
}

TEST_SUITE_END();
