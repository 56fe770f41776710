// SPDX-License-Identifier: MIT
// Light against closed forms.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "path_picture.hpp"
#include "path_scenes.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

namespace {

constexpr double pi = std::numbers::pi;

/// Light that should be there, and the largest number whose roundings it has.
struct Wanted {
    double value, magnitude;

    Wanted(double v) : value(v), magnitude(v) {}
    Wanted(double v, double m) : value(v), magnitude(m) {}
};

/// A pixel's red against what it should be, for light that has no noise.
void check_pixels(const Scene& scene, float half, Wanted (*expected)(const glm::dvec3&, const Material&)) {
    const LitScene lit(test_device(), scene);
    const Frame frame{8, 8};
    LightOptions options;
    options.samples = 1;
    options.depth = 1;
    const Picture picture = take_picture(test_device(), lit, camera_above(half), frame, options);
    for (std::uint32_t y = 0; y < 8; ++y)
        for (std::uint32_t x = 0; x < 8; ++x) {
            const Wanted wanted = expected(floor_point(half, 8, x, y), scene.materials[0]);
            const double found = picture.light(3 * (8 * y + x));
            CAPTURE(x);
            CAPTURE(y);
            // Some 64 roundings; and the clearance, 20 roundoffs of the floor's extent of 8, by which a light 1.5 above
            // is nearer.
            CHECK(std::abs(found - wanted.value) <= (64 + 214) * 0x1p-24 * wanted.magnitude);
        }
    CHECK(picture.unusable == 0);
}

const glm::dvec3 up(0, 1, 0);

Light punctual(LightKind kind) {
    Light light;
    light.kind = kind;
    light.intensity = {5, 4, 3};
    light.position = {0.5f, 1.5f, -0.25f};
    light.direction = {0.0f, -0.8f, 0.6f};
    return light;
}

std::uint32_t across(std::uint32_t pixels) { return small_sizes() ? 4 : pixels; }

const std::uint32_t quad_across = 16;

Estimate quad_estimate(Strategy strategy, SamplerKind sampler, const LitScene& lit, float half) {
    LightOptions options;
    options.strategy = strategy;
    options.sampler = sampler;
    options.samples = small_sizes() ? 4 : 36;
    options.depth = 1;
    options.seed = test_seed();
    return estimate(test_device(), lit, camera_above(half, 0.5f), {quad_across, quad_across}, options,
                    small_sizes() ? 3 : 12);
}

} // namespace

TEST_CASE("path: a plane under a point light") {
    Scene scene;
    add_floor(scene, matt({0.5f, 0.5f, 0.5f}));
    scene.lights = {punctual(LightKind::point)};
    check_pixels(scene, 1.0f, [](const glm::dvec3& p, const Material& m) -> Wanted {
        const glm::dvec3 l = glm::dvec3(0.5, 1.5, -0.25) - p;
        return 5 * glm::dot(reference_bsdf(m, up, up, glm::normalize(l)), glm::dvec3(1, 0, 0)) / glm::dot(l, l);
    });
    // With a range: nothing beyond it, the window of KHR_lights_punctual before.
    scene.lights[0].range = 2.0f;
    check_pixels(scene, 2.0f, [](const glm::dvec3& p, const Material& m) -> Wanted {
        const glm::dvec3 l = glm::dvec3(0.5, 1.5, -0.25) - p;
        const double window = std::max(1 - std::pow(glm::length(l) / 2, 4), 0.0);
        const double without = 5 * reference_bsdf(m, up, up, glm::normalize(l)).x / glm::dot(l, l);
        return {window * without, without}; // the window changes by as much where it closes
    });
}

TEST_CASE("path: a plane of metal and one with a coat under a directional light") {
    Scene scene;
    Material shiny = metal({0.9f, 0.6f, 0.3f}, 0.5f);
    for (const float metallic : {0.0f, 0.4f, 1.0f}) {
        shiny.metallic = metallic;
        scene = {};
        add_floor(scene, shiny);
        scene.lights = {punctual(LightKind::directional)};
        check_pixels(scene, 1.0f, [](const glm::dvec3&, const Material& m) -> Wanted {
            return 5 * reference_bsdf(m, up, up, glm::dvec3(0, 0.8, -0.6)).x;
        });
    }
}

TEST_CASE("path: a plane under a spot") {
    Scene scene;
    add_floor(scene, matt({0.5f, 0.5f, 0.5f}));
    scene.lights = {punctual(LightKind::spot)};
    scene.lights[0].inner_cone = 0.1f;
    scene.lights[0].outer_cone = 0.6f;
    check_pixels(scene, 1.5f, [](const glm::dvec3& p, const Material& m) -> Wanted {
        const glm::dvec3 l = glm::dvec3(0.5, 1.5, -0.25) - p, d = glm::normalize(l);
        const double cosine = -glm::dot(d, glm::dvec3(0, -0.8, 0.6));
        const double range = std::cos(0.1) - std::cos(0.6);
        const double edge = glm::clamp((cosine - std::cos(0.6)) / range, 0.0, 1.0);
        const double full = 5 * reference_bsdf(m, up, up, d).x / glm::dot(l, l);
        return {edge * edge * full, 2 * edge / range * full}; // near the cone's edge cosines of about 1 cancel
    });
}

TEST_CASE("path: a plane under a square that emits, by every strategy and sampler") {
    Scene scene;
    add_floor(scene, matt({0.5f, 0.5f, 0.5f}));
    add_quad(scene, {-0.5f, 1, -0.5f}, {1, 0, 0}, {0, 0, 1}, lamp(glm::vec3(3.0f))); // faces down
    const LitScene lit(test_device(), scene);
    const float half = 0.5f;
    double expected = 0.0;
    for (std::uint32_t i = 0; i < quad_across * quad_across; ++i) {
        const glm::dvec3 p = floor_point(half, quad_across, i % quad_across, i / quad_across);
        expected += 0.5 / pi * 3 / (quad_across * quad_across) *
                    polygon_irradiance(p, up, {{-0.5, 1, -0.5}, {0.5, 1, -0.5}, {0.5, 1, 0.5}, {-0.5, 1, 0.5}});
    }
    // Every strategy and every sampler, not all of their pairs: each is a program to compile.
    const std::pair<Strategy, SamplerKind> pairs[] = {{Strategy::mis, SamplerKind::sobol},
                                                      {Strategy::lights, SamplerKind::stratified},
                                                      {Strategy::bsdf, SamplerKind::sobol},
                                                      {Strategy::mis, SamplerKind::random}};
    for (const auto& pair : pairs) {
        const Strategy strategy = pair.first; // clang 14 captures no structured bindings
        const SamplerKind sampler = pair.second;
        CAPTURE(static_cast<int>(strategy));
        CAPTURE(static_cast<int>(sampler));
        const Estimate found = quad_estimate(strategy, sampler, lit, half);
        CHECK(std::abs(found.mean - expected) < found.margin());
        // 2 % would be seen.
        if (!small_sizes()) CHECK(found.error < 0.0066 * expected);
    }
}

TEST_CASE("path: a lamp shines to its front, to both sides when it is double-sided") {
    for (const bool both : {false, true}) {
        Scene scene;
        add_floor(scene, matt({0.5f, 0.5f, 0.5f}));
        Material material = lamp(glm::vec3(3.0f));
        material.double_sided = both;
        add_quad(scene, {-0.5f, 1, 0.5f}, {1, 0, 0}, {0, 0, -1}, material); // faces up
        const LitScene lit(test_device(), scene);
        for (const Strategy strategy : {Strategy::mis, Strategy::bsdf}) {
            const Estimate found = quad_estimate(strategy, SamplerKind::sobol, lit, 0.5f);
            CHECK((found.mean > 0.0) == both);
        }
    }
}

TEST_CASE("path: a white sphere in a white world cannot be seen") {
    // Every reflected ray of a convex body leaves: its light is its albedo, 1, whatever the tessellation.
    Scene scene;
    scene.materials = {matt(glm::vec3(1.0f))};
    scene.meshes = {sphere_mesh(small_sizes() ? 4 : 12, false)};
    scene.meshes[0].materials.assign(scene.meshes[0].triangles.size(), 0);
    scene.instances = {{"sphere", 0, glm::mat4(1.0f)}};
    Environment constant, picture;
    constant.radiance = glm::vec3(1.0f);
    picture.width = 16;
    picture.height = 8;
    picture.pixels.assign(128, glm::vec3(1.0f));
    const Camera camera{"camera", look_at({0, 1, 3}, {0, 0, 0}), false, 0.8f, 1.1f};
    for (const Environment* around : {&constant, &picture})
        for (const Strategy strategy : {Strategy::mis, Strategy::lights}) {
            CAPTURE(around->width);
            CAPTURE(static_cast<int>(strategy));
            const LitScene lit(test_device(), scene, *around);
            LightOptions options;
            options.strategy = strategy;
            options.samples = small_sizes() ? 4 : 16;
            options.seed = test_seed();
            const Estimate found = estimate(test_device(), lit, camera, {across(32), across(32)}, options, 6);
            CHECK(std::abs(found.mean - 1.0) < found.margin());
            CHECK(found.error < (small_sizes() ? 0.1 : 5e-3));
        }
}

TEST_CASE("path: white metal in a white world loses what single scattering loses") {
    Environment white;
    white.radiance = glm::vec3(1.0f);
    for (const float roughness : {0.0f, 0.3f, 1.0f})
        for (const double cosine : {0.9, 0.3}) {
            CAPTURE(roughness);
            CAPTURE(cosine);
            Scene scene;
            add_floor(scene, metal(glm::vec3(1.0f), roughness));
            const LitScene lit(test_device(), scene, white);
            const glm::dvec3 eye(3 * std::sqrt(1 - cosine * cosine), 3 * cosine, 0);
            const Camera camera{"camera", look_at(eye, {0, 0, 0}), false, 0.8f, 0.5f};
            LightOptions options;
            options.samples = small_sizes() ? 4 : 16;
            options.seed = test_seed();
            const Estimate found = estimate(test_device(), lit, camera, {across(24), across(24)}, options, 6);
            const double alpha = std::max(std::pow(double(roughness), 2), 0x1p-13);
            // Twice as fine a sum changes less than the coarser one is wrong.
            const double coarse = ggx_albedo(cosine, alpha, 128), expected = ggx_albedo(cosine, alpha, 256);
            CHECK(std::abs(found.mean - expected) < found.margin() + std::abs(expected - coarse));
            CHECK(found.error < (small_sizes() ? 0.1 : 5e-3));
        }
}

TEST_CASE("path: a closed white room returns what its lamp gives, bounce by bounce") {
    // Inside a sphere whose wall emits 1 and reflects a half, light after n bounces is the sum of 2^-k, k = 0 .. n.
    Scene scene;
    Material wall = matt(glm::vec3(0.5f));
    wall.emission = glm::vec3(1.0f);
    wall.double_sided = true;
    scene.materials = {wall};
    scene.meshes = {sphere_mesh(small_sizes() ? 4 : 8, false)};
    scene.meshes[0].materials.assign(scene.meshes[0].triangles.size(), 0);
    scene.instances = {{"sphere", 0, glm::mat4(1.0f)}};
    const LitScene lit(test_device(), scene);
    const Camera camera{"camera", look_at({0.2, 0.1, 0}, {0, 0, -1}), true, 1.2f};
    for (const std::uint32_t depth : {0u, 1u, 2u, 5u}) {
        CAPTURE(depth);
        LightOptions options;
        options.samples = small_sizes() ? 4 : 16;
        options.depth = depth;
        options.seed = test_seed();
        const Estimate found = estimate(test_device(), lit, camera, {across(16), across(16)}, options, 6);
        CHECK(std::abs(found.mean - (2.0 - std::exp2(-double(depth)))) < found.margin());
        CHECK(found.error < (small_sizes() ? 0.1 : 5e-3));
        options.strategy = Strategy::bsdf;
        const Picture picture = take_picture(test_device(), lit, camera, {8, 8}, options);
        // Without a light to sample every path brings the same, but for roulette from the third bounce on.
        if (depth <= 2)
            for (std::size_t i = 0; i < picture.direct.size(); ++i) {
                CHECK(picture.direct[i] == doctest::Approx(depth == 0 ? 1.0 : 1.5));
                CHECK(picture.indirect[i] == doctest::Approx(depth < 2 ? 0.0 : 0.25));
            }
    }
}

TEST_CASE("path: shadows behind what lets light pass") {
    // n layers that stop 0.3 each between a point light and the floor, seen from below them.
    for (const std::uint32_t layers : {0u, 1u, 3u}) {
        Scene scene;
        add_floor(scene, matt({0.5f, 0.5f, 0.5f}));
        Material veil = matt(glm::vec3(0.0f));
        veil.alpha_mode = AlphaMode::blend;
        veil.base_color.w = 0.3f;
        for (std::uint32_t i = 0; i < layers; ++i)
            add_quad(scene, {-4, 0.6f + 0.1f * float(i), 4}, {8, 0, 0}, {0, 0, -8}, veil);
        // Cut out where alpha is under the cutoff, and there where it is not.
        Material mask = veil;
        mask.alpha_mode = AlphaMode::mask;
        add_quad(scene, {-4, 1.2f, 4}, {8, 0, 0}, {0, 0, -8}, mask);
        scene.lights = {punctual(LightKind::point)};
        LightOptions options;
        options.samples = 1;
        options.depth = 1;
        const auto middle = [&](const Scene& s) {
            const LitScene lit(test_device(), s);
            return take_picture(test_device(), lit, camera_above(0.1f, 0.5f), {1, 1}, options).light(0);
        };
        const glm::dvec3 l(0.5, 1.5, -0.25);
        const double open = 5 * 0.5 / pi * 1.5 / std::pow(glm::length(l), 3);
        CHECK(middle(scene) == doctest::Approx(open * std::pow(0.7, layers)).epsilon(64 * 0x1p-24));
        scene.materials.back().base_color.w = 0.6f;
        CHECK(middle(scene) == 0.0);
    }
}

namespace {

/// A floor under a point light, and over it `layers` that a camera at y = `height` is above or below.
Scene layered_scene(std::uint32_t layers, const Material& material) {
    Scene scene;
    add_floor(scene, matt({0.5f, 0.5f, 0.5f}));
    scene.lights = {punctual(LightKind::point)};
    add_quad(scene, {-4, 0, 4}, {8, 0, 0}, {0, 0, -8}, material);
    scene.instances.back().transform[3].y = 8.0f; // none of the layers, but what needs the same programs
    for (std::uint32_t i = 0; i < layers; ++i) {
        scene.instances.push_back(scene.instances.back());
        scene.instances.back().transform[3].y = 0.6f + 0.5f * float(i) / float(layers);
    }
    return scene;
}

Material veil(AlphaMode mode, float alpha) {
    Material material = matt(glm::vec3(0.0f));
    material.alpha_mode = mode;
    material.base_color.w = alpha;
    return material;
}

} // namespace

TEST_CASE("path: layers without an alpha change nothing, however many") {
    for (const AlphaMode mode : {AlphaMode::blend, AlphaMode::mask})
        for (const float height : {0.5f, 2.0f}) { // under all layers, and over them
            if (small_sizes() && (mode == AlphaMode::mask) != (height > 1.0f)) continue;
            const Material material = veil(mode, mode == AlphaMode::mask ? 0.3f : 0.0f);
            const auto picture = [&](std::uint32_t layers) {
                const LitScene lit(test_device(), layered_scene(layers, material));
                LightOptions options;
                options.samples = 2;
                options.depth = 2;
                return take_picture(test_device(), lit, camera_above(0.3f, height), {2, 2}, options).direct;
            };
            const std::vector<double> open = picture(0);
            CHECK(open[0] > 0.0);
            for (const std::uint32_t layers : {64u, 65u, 200u, 1000u}) {
                if (small_sizes() && layers > 65) continue;
                CAPTURE(layers);
                CHECK(picture(layers) == open);
            }
        }
}

TEST_CASE("path: many layers that stop a part each let through, on average, what all leave") {
    const std::uint32_t layers = small_sizes() ? 70 : 150;
    const double share = std::pow(0.98, layers);
    for (const float height : {0.5f, 2.0f}) {
        if (small_sizes() && height > 1.0f) continue;
        const LitScene lit(test_device(), layered_scene(layers, veil(AlphaMode::blend, 0.02f)));
        const LitScene open(test_device(), layered_scene(0, veil(AlphaMode::blend, 0.02f)));
        LightOptions options;
        options.depth = 1;
        options.seed = test_seed();
        options.samples = 1;
        const Camera camera = camera_above(0.3f, height);
        const double all = estimate(test_device(), open, camera, {across(16), across(16)}, options, 2).mean;
        options.samples = small_sizes() ? 1 : 4;
        const Estimate found = estimate(test_device(), lit, camera, {across(64), across(64)}, options, 8);
        // Seen from above through them, of what light comes through them.
        const double expected = all * share * (height > 1.0f ? share : 1.0);
        CHECK(std::abs(found.mean - expected) < found.margin());
        if (!small_sizes()) CHECK(found.error < 0.1 * expected);
    }
}

TEST_CASE("path: seen through what lets light pass") {
    // A lamp of 2 behind two unlit layers of radiance 1 that stop a half each: 0.5 + 0.25 + 2 * 0.25, at any depth.
    Scene scene;
    add_floor(scene, lamp(glm::vec3(2.0f)));
    Material veil = matt(glm::vec3(1.0f));
    veil.alpha_mode = AlphaMode::blend;
    veil.base_color.w = 0.5f;
    veil.unlit = true;
    for (const float height : {0.5f, 1.0f}) add_quad(scene, {-4, height, 4}, {8, 0, 0}, {0, 0, -8}, veil);
    const LitScene lit(test_device(), scene);
    LightOptions options;
    options.samples = 16;
    options.depth = 0;
    options.seed = test_seed();
    const Estimate found = estimate(test_device(), lit, camera_above(1.0f), {across(16), across(16)}, options, 8);
    CHECK(std::abs(found.mean - 1.25) < found.margin());
    CHECK(found.error < (small_sizes() ? 0.1 : 5e-3));
}
