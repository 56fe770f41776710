// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "render/appearance_scenes.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

namespace {

/// Strengths of the leaves of the tree over lights.
std::vector<double> strengths(const Appearance& appearance) {
    const std::vector<LightNode> nodes = download(test_device(), appearance.light_nodes);
    std::vector<double> found;
    for (std::size_t i = nodes.size() / 2; i < nodes.size(); ++i)
        found.push_back(std::pow(double(nodes[i].amplitude), 2.0));
    return found;
}

} // namespace

TEST_CASE(
    "appearance_lights: emitting triangles are lights in world space, of instances that mirror and stretch, too") {
    Material lamp = plain_material();
    lamp.emission = {1, 2, 6};
    Scene scene = one_square(lamp);
    glm::mat4 placed = glm::translate(glm::mat4(1.0f), glm::vec3(5, 6, 7));
    placed = glm::rotate(placed, 0.7f, glm::vec3(1, 2, 3));
    placed = glm::scale(placed, glm::vec3(-2, 3, 0.5f));
    placed = glm::rotate(placed, 1.1f, glm::vec3(0, 1, 1));
    scene.instances.push_back({"mirrored", 0, placed});
    scene.lights.push_back({"lamp", LightKind::point, {3, 3, 3}, {1, 2, 3}});

    const Appearance appearance = appearance_of(scene);
    const auto lights = download(test_device(), appearance.lights);
    REQUIRE(lights.size() == 5);
    CHECK(lights[0].kind == BOXWOOD_POINT_LIGHT);
    std::vector<double> wanted = {3};
    for (std::uint32_t i = 1; i < 5; ++i) {
        const LightRecord& light = lights[i];
        CHECK(light.kind == BOXWOOD_TRIANGLE_LIGHT);
        CHECK(light.instance == (i - 1) / 2);
        CHECK(light.primitive == (i - 1) % 2);
        CHECK(light.intensity[2] == 6.0f);
        CHECK(light.two_sided == 0);
        // Heron's formula on the vertices in world space, and a point in front of the square in object space.
        const glm::dmat4 to_world(scene.instances[light.instance].transform);
        const glm::uvec3 t = scene.meshes[0].triangles[light.primitive];
        glm::dvec3 v[3];
        for (int k = 0; k < 3; ++k)
            v[k] = glm::dvec3(to_world * glm::dvec4(glm::dvec3(scene.meshes[0].positions[t[k]]), 1));
        const double a = glm::distance(v[0], v[1]), b = glm::distance(v[1], v[2]), c = glm::distance(v[2], v[0]);
        const double s = 0.5 * (a + b + c), area = std::sqrt(s * (s - a) * (s - b) * (s - c));
        CHECK(light.inverse_size == doctest::Approx(1 / std::sqrt(area)).epsilon(1e-6));
        const glm::dvec3 normal(light.direction[0], light.direction[1], light.direction[2]);
        CHECK(glm::length(normal) == doctest::Approx(1.0).epsilon(1e-6));
        CHECK(std::abs(glm::dot(normal, v[1] - v[0])) < 1e-6 * a);
        CHECK(std::abs(glm::dot(normal, v[2] - v[0])) < 1e-6 * c);
        const glm::dvec3 front(to_world * glm::dvec4(0, 0, 1, 0));
        CHECK(glm::dot(normal, front) > 0);
        for (int k = 0; k < 2; ++k)
            for (int axis = 0; axis < 3; ++axis)
                CHECK(light.edges[k][axis] == doctest::Approx(v[k + 1][axis] - v[0][axis]).epsilon(1e-5));
        wanted.push_back(3 * area);
    }
    const std::vector<double> found = strengths(appearance);
    REQUIRE(found.size() == wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i) CHECK(found[i] == doctest::Approx(wanted[i]).epsilon(1e-5));
}

TEST_CASE("appearance_lights: triangles without area or light are no lights; double-sided ones shine both ways; spots "
          "within their cone") {
    Material lamp = plain_material();
    lamp.emission = {1, 1, 1};
    lamp.double_sided = true;
    Scene scene = one_square(lamp);
    scene.meshes[0].triangles = {{0, 1, 2}, {0, 1, 1}, {0, 2, 3}};
    scene.meshes[0].materials = {0, 0, BOXWOOD_NONE};
    Light spot{"spot", LightKind::spot, {2, 2, 2}};
    spot.inner_cone = 0.2f;
    spot.outer_cone = 0.6f;
    scene.lights = {{"sun", LightKind::directional, {1, 1, 1}}, spot};
    const Appearance appearance = appearance_of(scene);
    const auto lights = download(test_device(), appearance.lights);
    REQUIRE(lights.size() == 3);
    CHECK(lights[2].primitive == 0);
    CHECK(lights[2].two_sided == 1);
    // Full at the inner cone, none at the outer one.
    const auto ramp = [&](double angle) {
        return (1 - std::pow(lights[1].cone_scale, 2) * (1 - std::cos(angle))) * lights[1].cone_edge;
    };
    CHECK(ramp(0.2) == doctest::Approx(1.0).epsilon(1e-5));
    CHECK(std::abs(ramp(0.6)) < 1e-5);

    const std::vector<double> wanted = {1, 2, 0.5}, found = strengths(appearance);
    for (std::size_t i = 0; i < 3; ++i) CHECK(found[i] == doctest::Approx(wanted[i]).epsilon(1e-5));
    const std::vector<LightNode> nodes = download(test_device(), appearance.light_nodes);
    CHECK(nodes[2].distant == 1);
    CHECK(std::atan2(nodes[3].spread_sine, nodes[3].spread_cosine) == doctest::Approx(0.6).epsilon(1e-5));
    CHECK(nodes[4].spread_cosine == -1.0f);
}

TEST_CASE("appearance_lights: a black emission texture makes no lights, and a partly black one weaker ones") {
    Material lamp = plain_material();
    lamp.emission = {1, 1, 1};
    lamp.emission_texture.texture = 0;
    Scene scene = one_square(lamp);
    scene.textures = {{0}};
    scene.images = {image("black", {1, 1}, {0, 0, 0, 255})};
    CHECK(appearance_of(scene).lights.size() == 0);
    scene.images = {image("half", {2, 1}, {0, 0, 0, 255, 255, 255, 255, 255})};
    scene.lights.push_back({"point", LightKind::point, glm::vec3(0.125f)});
    const Appearance appearance = appearance_of(scene);
    REQUIRE(appearance.lights.size() == 3);
    const std::vector<double> found = strengths(appearance);
    CHECK(found[0] == doctest::Approx(0.125));
    CHECK(found[1] == doctest::Approx(0.25));
}

TEST_SUITE_END();
