// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "render/appearance_scenes.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

namespace {

/// With what probability light i is chosen, the first `punctual` of them being punctual.
double share(const std::vector<double>& powers, std::size_t punctual, std::size_t i) {
    double total = 0;
    for (const double power : powers) total += power;
    return 15.0 / 16.0 * powers[i] / total + (i < punctual ? 1.0 / 16.0 / static_cast<double>(punctual) : 0.0);
}

} // namespace

TEST_CASE("emitting triangles are lights in world space, of instances that mirror and stretch, too") {
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
    std::vector<double> powers = {4 * std::numbers::pi * 3};
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
        powers.push_back(std::numbers::pi * 3 * area);
    }
    const auto distribution = download(test_device(), appearance.light_distribution);
    REQUIRE(distribution.size() == 6);
    CHECK(distribution.front() == 0.0f);
    CHECK(distribution.back() == 1.0f);
    for (std::size_t i = 0; i < powers.size(); ++i)
        CHECK(distribution[i + 1] - distribution[i] == doctest::Approx(share(powers, 1, i)).epsilon(1e-5));
}

TEST_CASE(
    "triangles without area or light are no lights; double-sided ones count twice; punctual ones by what they send") {
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

    double sent = 0; // by the spot: a sum over the angle from its axis
    const int steps = 100000;
    for (int i = 0; i < steps; ++i) {
        const double angle = std::numbers::pi * (i + 0.5) / steps;
        const double fade = std::clamp((std::cos(angle) - std::cos(0.6)) / (std::cos(0.2) - std::cos(0.6)), 0.0, 1.0);
        sent += 2 * std::numbers::pi * std::sin(angle) * 2 * fade * fade * std::numbers::pi / steps;
    }
    const std::vector<double> powers = {std::numbers::pi * 0.5, sent, std::numbers::pi * 0.5 * 2};
    const auto distribution = download(test_device(), appearance.light_distribution);
    for (std::size_t i = 0; i < 3; ++i)
        CHECK(distribution[i + 1] - distribution[i] == doctest::Approx(share(powers, 2, i)).epsilon(1e-5));
}

TEST_CASE("a black emission texture makes no lights, and a partly black one weaker ones") {
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
    // pi * 1/2 * 1/2 for each triangle, 4 pi / 8 for the point.
    const auto distribution = download(test_device(), appearance.light_distribution);
    const std::vector<double> powers = {0.5, 0.25, 0.25};
    CHECK(distribution[1] == doctest::Approx(share(powers, 1, 0)));
    CHECK(distribution[2] - distribution[1] == doctest::Approx(share(powers, 1, 1)));
}

TEST_CASE("punctual lights however dim are chosen, wherever they are in the list") {
    Scene scene = one_square(plain_material());
    const Light sun{"sun", LightKind::directional, glm::vec3(largest_radiance)};
    const Light dim{"dim", LightKind::point, glm::vec3(1e-30f)};
    for (const auto& lights : {std::vector<Light>{sun, dim, dim}, {dim, sun, dim}, {dim, dim, sun}}) {
        scene.lights = lights;
        const auto distribution = download(test_device(), appearance_of(scene).light_distribution);
        REQUIRE(distribution.size() == 4);
        for (std::size_t i = 0; i < 3; ++i) CHECK(distribution[i + 1] - distribution[i] >= (1 - 1e-5) / 16 / 3);
        CHECK(distribution[3] == 1.0f);
    }
    // A scene without extent gets no power from a sun.
    scene = {};
    scene.lights = {sun, dim, dim};
    const auto distribution = download(test_device(), appearance_of(scene).light_distribution);
    CHECK(distribution == std::vector<float>{0.0f, 0.0f, 0.5f, 1.0f});
}

TEST_SUITE_END();
