// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "bounds/lanes_of.hpp"
#include "render/appearance_scenes.hpp"
#include "render/light_tree_oracle.hpp"
#include "render/path_scenes.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

namespace {

using Point = std::array<float, 6>; ///< Position, the point that chooses the light and the place on it, and low bits.
using Place = std::array<float, 4>; ///< Instance, primitive, distance, cosine.

/// LightSample of cl/render/lights.h, for all lights having half the samples.
struct Found {
    glm::dvec3 segment;
    float t_max;
    glm::dvec3 direction, value;
    double pdf;
    std::size_t light;
};

struct Answers {
    std::vector<Found> samples;
    std::vector<double> densities; ///< Of the places.
};

Answers ask(const Scene& scene, const std::vector<Point>& points, std::vector<Place> places = {}) {
    Device& device = test_device();
    const Appearance appearance = appearance_of(scene);
    places.resize(points.size());
    const std::size_t count = padded(points.size());
    std::vector<float> a[2], b[2];
    for (const int k : {0, 1}) {
        const Guarded<float> samples(device, 12 * count), densities(device, count);
        launch(device, {"render/lights_test.cl", "lights_test", {{"LANES", k == 0 ? "1" : "16"}, {"TRANSFORMS", "1"}}},
               "lights test", count, appearance.lights, appearance.light_nodes,
               static_cast<std::uint32_t>(appearance.lights.size()), upload(device, by_components(points), "points"),
               upload(device, by_components(places), "places"), static_cast<std::uint32_t>(count), samples.view(),
               densities.view());
        CHECK(samples.intact());
        CHECK(densities.intact());
        a[k] = samples.values();
        b[k] = densities.values();
    }
    CHECK(same_bits(a[0], a[1]));
    CHECK(same_bits(b[0], b[1]));
    Answers answers;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto of = [&](std::size_t component) { return a[1][component * count + i]; };
        answers.samples.push_back({{of(0), of(1), of(2)},
                                   of(3),
                                   {of(4), of(5), of(6)},
                                   {of(7), of(8), of(9)},
                                   of(10),
                                   static_cast<std::size_t>(of(11))});
        answers.densities.push_back(b[1][i]);
    }
    return answers;
}

/// A lamp of two triangles, one that shines to both sides, and a light of each other kind, around the origin.
Scene all_lights() {
    Scene scene;
    add_quad(scene, {-0.25f, 1, 0.5f}, {0, 0, -0.5f}, {0.75f, 0.125f, 0}, lamp({3, 2, 1}));
    Material both = lamp({0.5f, 4, 2});
    both.double_sided = true;
    add_quad(scene, {1, -0.5f, 0.25f}, {0.125f, 0.5f, 0.125f}, {0, 0.25f, 0.5f}, both);
    Light point{"point", LightKind::point, {2, 1, 0.5f}, {-1, 0.5f, 0.75f}};
    point.range = 4.0f;
    Light spot = point;
    spot.kind = LightKind::spot;
    spot.direction = glm::normalize(glm::vec3(1, -0.5f, -0.7f));
    spot.inner_cone = 0.3f;
    spot.range = 3.0f;
    scene.lights = {point, spot, {"sun", LightKind::directional, {1, 2, 4}}};
    return scene;
}

std::vector<Point> random_points(std::size_t count, float scale) {
    Random random(83);
    std::vector<Point> points(count);
    for (Point& point : points) {
        for (int k = 0; k < 3; ++k) point[k] = scale * random.uniform(-0.75f, 0.75f);
        for (int k = 3; k < 6; ++k) point[k] = std::min(random.uniform(0, 1), 0.99999994f);
    }
    return points;
}

} // namespace

TEST_CASE("lights: the same light at every scale of the scene") {
    const std::size_t count = small_sizes() ? 16 : 4096;
    for (const int k : {-62, -40, -3, 40, 55}) {
        CAPTURE(k);
        // Intensities stay in their range: those of lights at a point go with the square of the scale.
        Scene scene = all_lights();
        for (Light& light : scene.lights) light.intensity *= k > 0 ? 0x1p-50f : 1.0f;
        const float scale = std::ldexp(1.0f, k);
        const Answers original = ask(scene, random_points(count, 1.0f));
        const Answers changed = ask(scaled(scene, scale), random_points(count, scale));
        std::size_t lit = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const Found &a = original.samples[i], &b = changed.samples[i];
            const bool distant = a.t_max > 1.0f;
            CHECK(b.segment == a.segment * (distant ? 1.0 : double(scale)));
            CHECK(b.t_max == a.t_max);
            CHECK(b.direction == a.direction);
            CHECK(b.value == a.value);
            CHECK(b.pdf == a.pdf);
            lit += a.value.x > 0.0 ? 1 : 0;
        }
        CHECK(lit > count / 4);
    }
}

TEST_CASE("lights: places on lamps, their radiance and their density, as in double precision") {
    Scene scene = all_lights();
    scene.lights.clear();
    const std::size_t count = small_sizes() ? 16 : 4096;
    const std::vector<LightNode> nodes = download(test_device(), appearance_of(scene).light_nodes);
    REQUIRE(nodes.size() == 7);
    std::size_t compared = 0;
    const std::vector<Point> points = random_points(count, 1.0f);
    std::vector<Place> places(count);
    std::vector<double> densities(count);
    const Answers answers = ask(scene, points);
    for (std::size_t i = 0; i < count; ++i) {
        const Found& found = answers.samples[i];
        const glm::dvec3 origin(points[i][0], points[i][1], points[i][2]);
        const ChosenLight wanted = choose_light(nodes, 0, origin, points[i][3]);
        if (wanted.margin < 1e-4) continue;
        ++compared;
        const std::size_t chosen = wanted.light;
        CHECK(found.light == chosen);
        const Mesh& mesh = scene.meshes[chosen / 2];
        const glm::uvec3 t = mesh.triangles[chosen % 2];
        glm::dvec3 v[3];
        for (int k = 0; k < 3; ++k) v[k] = glm::dvec3(mesh.positions[t[k]]);
        const glm::dvec3 across = glm::cross(v[1] - v[0], v[2] - v[0]), normal = glm::normalize(across);
        const double root = std::sqrt(wanted.rest), area = 0.5 * glm::length(across);
        const glm::dvec3 place =
            v[0] + root * (1.0 - points[i][4]) * (v[1] - v[0]) + root * points[i][4] * (v[2] - v[0]);
        const glm::dvec3 segment = place - origin, direction = glm::normalize(segment);
        // Shares in float move what is left of u by some roundoffs over the probability, which the root takes.
        const double apart = 1e-5 + 1e-6 / (wanted.probability * std::max(root, 0.01));
        CHECK(glm::distance(found.segment, segment) < apart);
        CHECK(glm::distance(found.direction, direction) < 2 * apart / glm::length(segment));
        // The segment ends clear of the lamp, some 4e-6 here, which turns it by that over its length.
        const double facing = -glm::dot(direction, normal), cosine = std::abs(facing);
        const double tolerance = 2 * apart / (glm::length(segment) * cosine);
        if (tolerance > 0.01) continue;
        const double density = wanted.probability * glm::dot(segment, segment) / (cosine * area);
        const bool lit = facing > 0 || scene.materials[chosen / 2].double_sided;
        CHECK(std::abs(found.pdf - (lit ? 0.5 * density : 0.0)) <= tolerance * density);
        const glm::dvec3 value =
            lit ? glm::dvec3(scene.materials[chosen / 2].emission) / (0.5 * density) : glm::dvec3(0);
        CHECK(glm::distance(found.value, value) <= tolerance * glm::length(value));
        places[i] = {float(chosen / 2), float(chosen % 2), float(glm::length(segment)), float(cosine)};
        densities[i] = density;
    }
    CHECK(compared > count / 2);
    const Answers again = ask(scene, points, places);
    for (std::size_t i = 0; i < count; ++i)
        if (places[i][2] > 0.0f) CHECK(again.densities[i] == doctest::Approx(densities[i]).epsilon(1e-5));
}

TEST_CASE("lights: what is no lamp has no density, nor has what a ray met from behind its plane") {
    const Scene scene = all_lights();
    const float none = 4294967040.0f; // the largest that the kernel takes: no instance has it
    const std::vector<Place> places = {{2, 0, 1, 1}, {0, 2, 1, 1},  {none, 0, 1, 1}, {1, none, 1, 1},
                                       {0, 0, 1, 0}, {0, 0, 1, -1}, {0, 0, 1, 1}};
    const Answers answers = ask(scene, random_points(places.size(), 1.0f), places);
    for (std::size_t i = 0; i + 1 < places.size(); ++i) CHECK(answers.densities[i] == 0.0);
    CHECK(answers.densities.back() > 0.0);
}

TEST_CASE("lights: the cones of spots, however narrow, as in double precision") {
    for (const double outer : {1e-5, 1e-3, 0.05, 0.7, 1.57})
        for (const double part : {0.0, 0.5, 0.99}) {
            CAPTURE(outer);
            CAPTURE(part);
            Light spot{"spot", LightKind::spot, glm::vec3(1)};
            spot.direction = glm::normalize(glm::vec3(0.6f, -0.5f, 0.3f));
            spot.outer_cone = float(outer);
            spot.inner_cone = float(part * outer);
            Scene scene;
            scene.lights = {spot};
            const glm::dvec3 axis = glm::normalize(glm::dvec3(spot.direction));
            const glm::dvec3 side = glm::normalize(glm::cross(axis, glm::dvec3(0.1, 0.2, 1)));
            std::vector<Point> points;
            const int steps = small_sizes() ? 16 : 500;
            for (int i = 0; i < steps; ++i) {
                const double angle = 1.2 * outer * i / steps;
                const glm::dvec3 p = 3.0 * (std::cos(angle) * axis + std::sin(angle) * side);
                points.push_back({float(p.x), float(p.y), float(p.z), 0, 0, 0});
            }
            const Answers answers = ask(scene, points);
            // By the points as they are in float, and angles, of which none is near a right one.
            const double sharpness = 1.0 / (1.0 - std::pow(double(spot.inner_cone) / spot.outer_cone, 2.0));
            const double o = spot.outer_cone, n = spot.inner_cone;
            const double fading = 2.0 * std::sin(0.5 * (o + n)) * std::sin(0.5 * (o - n));
            for (std::size_t i = 0; i < points.size(); ++i) {
                const glm::dvec3 p(points[i][0], points[i][1], points[i][2]);
                const double angle = std::atan2(glm::length(glm::cross(p, axis)), glm::dot(p, axis));
                const double short_of = 2.0 * std::sin(0.5 * (o + angle)) * std::sin(0.5 * (o - angle));
                const double edge = std::clamp(short_of / fading, 0.0, 1.0);
                const double value = edge * edge / glm::dot(p, p) / 0.5;
                CHECK(std::abs(answers.samples[i].value.x - value) <= 2e-6 * sharpness * 2.0 / 9.0);
            }
        }
}

TEST_SUITE_END();
