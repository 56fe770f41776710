// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "boxwood/influence.hpp"
#include "boxwood/scene.hpp"
#include "influence/random_areas.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("influence");

namespace {

/// A tetrahedron of size 2 about the origin, placed twice.
Scene two_tetrahedra(double scale = 1) {
    Scene scene;
    Mesh mesh{
        "solid", {{-1, -1, -1}, {1, 1, -1}, {1, -1, 1}, {-1, 1, 1}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}};
    for (glm::vec3& p : mesh.positions) p *= float(scale);
    scene.meshes.push_back(mesh);
    const glm::dmat4 moved = glm::translate(glm::dmat4(1), scale * glm::dvec3(5, 2, -3));
    scene.instances = {{"a", 0, glm::mat4(1)}, {"b", 0, glm::mat4(moved)}};
    return scene;
}

std::vector<glm::dvec3> world_vertices(const Scene& scene) {
    std::vector<glm::dvec3> vertices;
    for (const Instance& instance : scene.instances)
        for (const glm::vec3& p : scene.meshes[instance.mesh].positions)
            vertices.emplace_back(glm::dmat4(instance.transform) * glm::dvec4(p, 1));
    return vertices;
}

Light light(LightKind kind, const glm::vec3& position, const glm::vec3& direction) {
    Light light;
    light.kind = kind;
    light.position = position;
    light.direction = glm::normalize(direction);
    return light;
}

glm::dvec3 vector(const float* v) { return {v[0], v[1], v[2]}; }

} // namespace

TEST_CASE("light_areas: a directional light's holds the scene") {
    Random random(101);
    for (int i = 0; i < 30; ++i) {
        const double scale = std::exp2(double(random.below(101)) - 50);
        Scene scene = two_tetrahedra(scale);
        scene.lights.push_back(light(LightKind::directional, {}, random_direction(random)));
        const std::vector<InfluenceArea> areas = areas_from_lights(scene);
        REQUIRE(areas.size() == 1);
        CHECK(areas[0].kind == AreaKind::plane);
        CHECK(areas[0].direction == glm::dvec3(scene.lights[0].direction));
        const InfluenceRecord record = influence_records(areas)[0];
        for (const glm::dvec3& p : world_vertices(scene)) CHECK(contains(record, p));
        CHECK(areas[0].far < 12 * scale);
        CHECK(areas[0].half_width < 6 * scale);
    }
    // Far from the origin, where positions round by a hundredth of the scene.
    for (int i = 0; i < 30; ++i) {
        Scene scene = two_tetrahedra();
        for (Instance& instance : scene.instances) instance.transform[3] += glm::vec4(0x1p20f, -0x1p20f, 0x1.8p20f, 0);
        scene.lights.push_back(light(LightKind::directional, {}, random_direction(random)));
        const std::vector<InfluenceArea> areas = areas_from_lights(scene);
        REQUIRE(areas.size() == 1);
        const InfluenceRecord record = influence_records(areas)[0];
        for (const glm::dvec3& p : world_vertices(scene)) CHECK(contains(record, p));
    }
}

TEST_CASE("light_areas: what a point or a spot light lights is in one of its areas") {
    Scene scene = two_tetrahedra();
    const auto covered = [&](const Light& lamp, bool all) {
        scene.lights = {lamp};
        const std::vector<InfluenceArea> areas = areas_from_lights(scene);
        CHECK(areas.size() <= 6);
        const std::vector<InfluenceRecord> records = influence_records(areas);
        for (const glm::dvec3& p : world_vertices(scene)) {
            const glm::dvec3 way = p - glm::dvec3(lamp.position);
            const double angle = std::acos(glm::dot(glm::normalize(way), glm::dvec3(lamp.direction)));
            if (!all && angle > lamp.outer_cone) continue;
            if (glm::length(way) > lamp.range) continue;
            CHECK(std::any_of(records.begin(), records.end(),
                              [&](const InfluenceRecord& area) { return contains(area, p); }));
        }
        return areas.size();
    };
    CHECK(covered(light(LightKind::point, {0.1f, 0.2f, 0}, {0, 0, -1}), true) == 6); // in the midst
    CHECK(covered(light(LightKind::point, {0.1f, 50, 0}, {0, 0, -1}), true) == 1);   // above: one face of the cube
    CHECK(covered(light(LightKind::point, {20, 20, -2}, {0, 0, -1}), true) == 2);
    Light narrow = light(LightKind::spot, {0, 9, 0}, {0.2f, -1, 0});
    narrow.outer_cone = 0.5f;
    CHECK(covered(narrow, false) == 1);
    Light wide = narrow;
    wide.outer_cone = 1.5f;
    CHECK(covered(wide, false) >= 1);
    Light away = narrow;
    away.direction = {0, 1, 0};
    CHECK(covered(away, false) == 0);
    Light near = light(LightKind::point, {0, 9, 0}, {0, 0, -1});
    near.range = 0.5f; // reaches nothing
    CHECK(covered(near, true) == 0);
    for (const float scale : {0x1p-52f, 0x1p52f}) { // at the ends of coordinates too
        Scene far_scene = two_tetrahedra(double(scale));
        far_scene.lights = {light(LightKind::point, {0.1f * scale, 50 * scale, 0}, {0, 0, -1})};
        CHECK(areas_from_lights(far_scene).size() == 1);
    }
    Scene empty;
    empty.lights = {wide};
    CHECK(areas_from_lights(empty).empty());
    scene.lights = std::vector<Light>(100, narrow);
    CHECK(areas_from_lights(scene).size() == most_light_areas);
}

TEST_CASE("light_areas: a flat lamp's lies over its rectangle, on the sides that emit") {
    Scene scene = two_tetrahedra();
    scene.materials.resize(2);
    scene.materials[1].emission = glm::vec3(3);
    // A rectangle of 2 x 1 in the plane y = 0 that looks down, and one triangle of it that does not emit.
    Mesh lamp{"lamp",
              {{-1, 0, -0.5f}, {1, 0, -0.5f}, {1, 0, 0.5f}, {-1, 0, 0.5f}, {9, 0, 0}},
              {{0, 1, 2}, {0, 2, 3}, {0, 1, 4}}};
    lamp.materials = {1, 1, 0};
    scene.meshes.push_back(lamp);
    const glm::mat4 up = glm::translate(glm::mat4(1), glm::vec3(0, 8, 0));
    scene.instances.push_back({"lamp", 1, up});
    std::vector<InfluenceArea> areas = areas_from_lights(scene);
    REQUIRE(areas.size() == 1);
    CHECK(areas[0].kind == AreaKind::plane);
    CHECK(glm::length(areas[0].origin - glm::dvec3(0, 8, 0)) < 1e-6);
    CHECK(areas[0].direction.y == doctest::Approx(-1));
    CHECK(std::min(areas[0].half_width, areas[0].half_height) == doctest::Approx(0.5).epsilon(0.01));
    CHECK(std::max(areas[0].half_width, areas[0].half_height) == doctest::Approx(1).epsilon(0.01));
    CHECK(areas[0].far == doctest::Approx(9).epsilon(0.01)); // down to y = -1
    CHECK(areas[0].tolerance_degrees == doctest::Approx(glm::degrees(std::atan(std::sqrt(5.0) / 9))).epsilon(0.01));
    const InfluenceRecord record = influence_records(areas)[0];
    for (const int corner : {0, 1, 2, 3})
        CHECK(contains(record, glm::dvec3(lamp.positions[corner]) + glm::dvec3(0, 8 - 1e-4, 0)));
    CHECK(vector(record.forward).y == doctest::Approx(-1));

    // A mirrored one looks the same way in its own space: up, where there is nothing to light.
    scene.instances[2].transform = up * glm::scale(glm::mat4(1), glm::vec3(1, -1, 1));
    CHECK(areas_from_lights(scene).empty());
    scene.instances[2].transform =
        glm::translate(glm::mat4(1), glm::vec3(0, -8, 0)) * glm::scale(glm::mat4(1), glm::vec3(1, -1, 1));
    areas = areas_from_lights(scene);
    REQUIRE(areas.size() == 1);
    CHECK(areas[0].direction.y == doctest::Approx(1));
    scene.instances[2].transform = glm::mat4(1);
    CHECK(areas_from_lights(scene).size() == 1);
    scene.materials[1].double_sided = true; // in the midst: to both sides
    CHECK(areas_from_lights(scene).size() == 2);
    scene.meshes[1].positions[2].y = 0.4f; // not flat
    CHECK(areas_from_lights(scene).empty());
}

TEST_SUITE_END();
