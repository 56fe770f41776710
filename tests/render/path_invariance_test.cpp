// SPDX-License-Identifier: MIT
// What light does not depend on: the strategy, the cut of the work, mirrors, scale. And what must not harm it.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "boxwood/error.hpp"
#include "path_picture.hpp"
#include "path_scenes.hpp"
#include "support.hpp"
#include "tuning.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

namespace {

LightOptions seeded(std::uint32_t samples, std::uint32_t depth) {
    LightOptions options;
    options.samples = samples;
    options.depth = depth;
    options.seed = test_seed();
    return options;
}

bool same(const Picture& a, const Picture& b) { return a.direct == b.direct && a.indirect == b.indirect; }

/// Means agree to four standard errors of some ten pictures, which are at most `share` of them. Under a checker there
/// are too few paths for that.
void check_agree(const Estimate& a, const Estimate& b, double share) {
    const double error = std::hypot(a.error, b.error);
    CHECK(std::isfinite(a.mean + error));
    if (small_sizes()) return;
    CHECK(std::abs(a.mean - b.mean) <= 4 * error);
    CHECK(error <= share * b.mean);
}

/// The Cornell box with a point light and a spot beside its lamp, a smooth sphere placed by a turned transform, and a
/// veil.
Scene rich_scene() {
    Scene scene = cornell_scene();
    Light point;
    point.position = {-0.5f, 0.4f, 0.3f};
    point.range = 3.0f;
    Light spot = point;
    spot.kind = LightKind::spot;
    spot.direction = glm::normalize(glm::vec3(0.3f, -1, -0.2f));
    scene.lights = {point, spot};
    scene.meshes.push_back(sphere_mesh(8, true));
    glm::mat4 transform = glm::translate(glm::mat4(1.0f), {0.25f, 0.0f, 0.5f});
    transform = glm::scale(glm::rotate(transform, 0.7f, {0, 0, 1}), {0.3f, 0.2f, -0.25f});
    scene.instances.push_back({"ball", static_cast<std::uint32_t>(scene.meshes.size() - 1), transform});
    Material veil = matt({0.2f, 0.4f, 0.8f});
    veil.alpha_mode = AlphaMode::blend;
    veil.base_color.w = 0.5f;
    add_quad(scene, {-0.75f, -0.5f, 0.75f}, {0.5f, 0, 0}, {0, 1, 0}, veil);
    return scene;
}

} // namespace

TEST_CASE("path_invariance: the Cornell box is as bright by every strategy, sampler and hemisphere") {
    const LitScene lit(test_device(), cornell_scene());
    const Camera camera = cornell_scene().cameras[0];
    const Frame frame{small_sizes() ? 2u : 24u, small_sizes() ? 2u : 24u};
    const std::uint32_t samples = small_sizes() ? 2 : 16, repeats = small_sizes() ? 3 : 10;
    const Estimates reference = estimates(test_device(), lit, camera, frame, seeded(samples, 5), repeats);
    std::vector<LightOptions> others(4, seeded(samples, 5));
    others[0].strategy = Strategy::lights;
    others[1].strategy = Strategy::bsdf;
    others[1].hemisphere = Hemisphere::uniform;
    others[1].samples *= 4;
    others[2].sampler = SamplerKind::stratified;
    others[3].sampler = SamplerKind::random;
    others[3].hemisphere = Hemisphere::uniform;
    for (std::size_t i = 0; i < others.size(); ++i) {
        CAPTURE(i);
        others[i].seed += 1000 * (i + 1);
        const Estimates found = estimates(test_device(), lit, camera, frame, others[i], repeats);
        // By the surface alone, the lamp is found by chance.
        const bool by_chance = others[i].strategy == Strategy::bsdf;
        check_agree(found.direct, reference.direct, by_chance ? 0.015 : 0.002);
        check_agree(found.indirect, reference.indirect, by_chance ? 0.05 : 0.03);
        check_agree(found.light, reference.light, by_chance ? 0.015 : 0.006);
    }
}

TEST_CASE("path_invariance: a lamp and a sky together are as bright by every strategy") {
    Scene scene;
    add_floor(scene, metal({0.9f, 0.8f, 0.7f}, 0.6f));
    add_quad(scene, {-0.5f, 1, -0.5f}, {1, 0, 0}, {0, 0, 1}, lamp(glm::vec3(3.0f)));
    add_quad(scene, {-1, 0, -0.6f}, {2, 0, 0}, {0, 0.5f, 0}, matt(glm::vec3(0.8f)));
    scene.lights.resize(1);
    scene.lights[0].position = {0.9f, 0.8f, 0.5f};
    const LitScene lit(test_device(), scene, default_sky());
    const Frame frame{small_sizes() ? 2u : 24u, small_sizes() ? 2u : 24u};
    const Camera camera{"camera", look_at({0, 1.5, 2}, {0, 0.3, 0}), true, 0.8f};
    LightOptions options = seeded(small_sizes() ? 2 : 32, 3);
    const std::uint32_t repeats = small_sizes() ? 3 : 8;
    const Estimate both = estimate(test_device(), lit, camera, frame, options, repeats);
    options.strategy = Strategy::lights;
    options.seed += 1000;
    const Estimate lights = estimate(test_device(), lit, camera, frame, options, repeats);
    check_agree(lights, both, 0.01);
    // The sun, which the surface finds once in thousands of samples, is left out.
    Environment dim = default_sky();
    for (glm::vec3& pixel : dim.pixels) pixel = glm::min(pixel, glm::vec3(2.0f));
    const LitScene hazy(test_device(), scene, dim);
    options.strategy = Strategy::mis;
    const Estimate hazy_both = estimate(test_device(), hazy, camera, frame, options, repeats);
    options.strategy = Strategy::bsdf;
    options.samples *= 2;
    options.seed += 1000;
    const Estimate bsdf = estimate(test_device(), hazy, camera, frame, options, repeats);
    check_agree(bsdf, hazy_both, 0.005);
}

TEST_CASE("path_invariance: a lamp under a roof gives the same light when a sun shines on the roof") {
    // The sun gives off 10^10 times as much: by power alone, in float, the lamp would never be chosen.
    Scene scene;
    add_floor(scene, matt(glm::vec3(0.8f)));
    add_quad(scene, {-50, 5, -50}, {100, 0, 0}, {0, 0, 100}, matt(glm::vec3(0.8f)));
    add_quad(scene, {-5000, -10, 5000}, {10000, 0, 0}, {0, 0, -10000}, matt(glm::vec3(0.8f)));
    Light lamp{"lamp", LightKind::point, glm::vec3(100.0f)};
    lamp.position = {0.5f, 1.5f, -0.25f};
    Light sun{"sun", LightKind::directional, glm::vec3(1e5f)};
    sun.direction = {0, -1, 0};
    const Camera camera = camera_above(1.0f);
    const Frame frame{small_sizes() ? 4u : 16u, small_sizes() ? 4u : 16u};
    // One in 32 samples takes the lamp.
    LightOptions options = seeded(small_sizes() ? 16 : 64, 1);
    const std::uint32_t repeats = small_sizes() ? 4 : 16;
    scene.lights = {lamp};
    const Estimate alone = estimate(test_device(), LitScene(test_device(), scene), camera, frame, options, 2);
    scene.lights = {sun, lamp};
    const Estimate both = estimate(test_device(), LitScene(test_device(), scene), camera, frame, options, repeats);
    CHECK(alone.mean > 0.0);
    CHECK(alone.error <= 1e-6 * alone.mean); // a point's light has no noise
    CHECK(std::abs(both.mean - alone.mean) < 4 * both.error + 1e-5 * alone.mean);
    if (!small_sizes()) CHECK(both.error < 0.03 * alone.mean);
}

TEST_CASE("path_invariance: the same bytes for any cut of the work and any order of the pixels") {
    const Scene scene = rich_scene();
    const LitScene lit(test_device(), scene, default_sky());
    const std::uint32_t across = small_sizes() ? 3 : 13; // no multiple of a batch or a slice
    const LightOptions options = seeded(2, 4);
    const auto take = [&](std::uint32_t batch, bool backwards) {
        return take_picture(test_device(), lit, scene.cameras[0], {across, across, batch, backwards}, options);
    };
    const Picture whole = take(0, false);
    CHECK(whole.unusable == 0);
    CHECK(same(take(small_sizes() ? 2 : 40, false), whole));
    CHECK(same(take(small_sizes() ? 4 : 7, true), whole));
    for (const Tuning& tuning : tunings()) { // by one lane, eight and sixteen
        CAPTURE(tuning.group_size);
        const TuningScope scope(tuning);
        CHECK(same(take(0, false), whole));
        CHECK(same(take(small_sizes() ? 2 : 5, true), whole)); // fewer than lanes
    }
    LightOptions other = options;
    other.seed += 1;
    CHECK(!same(take_picture(test_device(), lit, scene.cameras[0], {across, across}, other), whole));
}

TEST_CASE("path_invariance: memory does not depend on the number of threads") {
    const Scene scene = rich_scene();
    const LitScene lit(test_device(), scene, default_sky());
    const std::uint32_t across = small_sizes() ? 4 : 64;
    check_memory_by_compute_units([&] {
        take_picture(test_device(), lit, scene.cameras[0], {across, across}, seeded(1, 4));
    });
}

TEST_CASE("path_invariance: scene and lights scaled by a power of two give the same picture") {
    const Scene scene = rich_scene();
    const std::uint32_t across = small_sizes() ? 2 : 12;
    const auto take = [&](const Scene& s) {
        const LitScene lit(test_device(), s, default_sky());
        return take_picture(test_device(), lit, s.cameras[0], {across, across}, seeded(1, 4));
    };
    const Picture original = take(scene);
    CHECK(*std::max_element(original.direct.begin(), original.direct.end()) > 0.0);
    for (const int k : {-54, -40, -3, 40, 55}) {
        CAPTURE(k);
        CHECK(same(take(scaled(scene, std::ldexp(1.0f, k))), original));
    }
}

TEST_CASE("path_invariance: a mirrored instance is lit as the mirrored mesh is") {
    // A lopsided ball of two materials with normals, one of them shining to its front, on a floor: placed by a
    // transform of negative determinant, and built of mirrored vertices with the sense of its triangles turned.
    Mesh ball = sphere_mesh(small_sizes() ? 4 : 10, true);
    for (std::size_t i = 0; i < ball.positions.size(); ++i) {
        ball.positions[i] = ball.positions[i] * glm::vec3(0.5f, 0.7f, 0.4f) + glm::vec3(0.3f, 0.8f, 0.1f);
        ball.normals[i] = glm::normalize(ball.normals[i] / glm::vec3(0.5f, 0.7f, 0.4f));
    }
    for (std::size_t i = 0; i < ball.triangles.size(); ++i) ball.materials.push_back(i % 3 == 0 ? 1 : 2);
    Mesh mirrored = ball;
    for (std::size_t i = 0; i < ball.positions.size(); ++i) mirrored.positions[i].x *= -1, mirrored.normals[i].x *= -1;
    for (glm::uvec3& t : mirrored.triangles) std::swap(t.y, t.z);
    Scene scenes[2];
    for (int k = 0; k < 2; ++k) {
        Scene& scene = scenes[k];
        add_floor(scene, matt(glm::vec3(0.5f)));
        scene.materials.push_back(lamp(glm::vec3(2.0f)));
        scene.materials.push_back(metal(glm::vec3(0.8f), 0.5f));
        scene.meshes.push_back(k == 0 ? ball : mirrored);
        scene.instances.push_back({"ball", 1, glm::mat4(1.0f)});
        if (k == 0) scene.instances[1].transform[0][0] = -1.0f;
        scene.lights.resize(1);
        scene.lights[0].position = {1.5f, 2.0f, 1.0f};
        scene.lights[0].intensity = glm::vec3(4.0f);
    }
    const Camera camera{"camera", look_at({-1, 1.5, 3}, {-0.2, 0.6, 0}), true, 0.8f};
    const std::uint32_t across = small_sizes() ? 4 : 24;
    const LitScene a(test_device(), scenes[0]), b(test_device(), scenes[1]);
    // What is emitted, and light from the point: no noise. Pixels on edges between triangles may fall to either.
    LightOptions options = seeded(1, 0);
    const Picture emitted[2] = {take_picture(test_device(), a, camera, {across, across}, options),
                                take_picture(test_device(), b, camera, {across, across}, options)};
    CHECK(*std::max_element(emitted[0].direct.begin(), emitted[0].direct.end()) == 2.0);
    std::size_t different = 0;
    for (std::size_t i = 0; i < emitted[0].direct.size(); ++i)
        if (emitted[0].direct[i] != emitted[1].direct[i]) ++different;
    CHECK(different <= emitted[0].direct.size() / 100);
    options = seeded(small_sizes() ? 2 : 32, 2);
    const Estimate first = estimate(test_device(), a, camera, {across, across}, options, 6);
    options.seed += 1000;
    const Estimate second = estimate(test_device(), b, camera, {across, across}, options, 6);
    check_agree(second, first, 0.005);
}

TEST_CASE("path_invariance: nothing that is not light, whatever the scene is like") {
    Scene scene = rich_scene();
    // Normals of zero, triangles without area that shine, lights in surfaces, at one another's place, of no intensity,
    // and so strong that their light passes the range of float.
    for (std::size_t i = 0; i < scene.meshes[8].normals.size(); i += 2) scene.meshes[8].normals[i] = glm::vec3(0.0f);
    const auto shining = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.push_back(lamp(glm::vec3(1.0f)));
    scene.materials.push_back(metal(glm::vec3(1.0f), 0.0f));
    Mesh flat{"flat", {{0, 0, 0}, {0.5f, 0, 0}, {1, 0, 0}, {0, 0, 0}}, {{0, 1, 2}, {0, 0, 0}, {0, 3, 0}}};
    flat.materials.assign(3, shining);
    scene.meshes.push_back(flat);
    scene.instances.push_back({"flat", static_cast<std::uint32_t>(scene.meshes.size() - 1), glm::mat4(1.0f)});
    scene.meshes[0].materials.assign(scene.meshes[0].triangles.size(), shining + 1); // a mirror for a floor
    Light on_floor, strong, none;
    on_floor.position = {0.0f, -1.0f, 0.5f};
    strong.position = {0.1f, -1.0f, 0.5f};
    strong.intensity = glm::vec3(3e38f);
    none.intensity = glm::vec3(0.0f);
    none.position = on_floor.position;
    scene.lights.insert(scene.lights.end(), {on_floor, strong, none});
    const LitScene lit(test_device(), scene, default_sky());
    const Camera inside{"inside", look_at({-0.3125, -0.5, -0.25}, {0, 0, 4}), true, 2.5f};
    const Camera in_wall{"in the wall", look_at({-1, 0, 0}, {0, 0, 4}), true, 1.5f};
    const std::uint32_t across = small_sizes() ? 3 : 20;
    for (const Camera& camera : {scene.cameras[0], inside, in_wall})
        for (const Strategy strategy : {Strategy::mis, Strategy::bsdf}) {
            LightOptions options = seeded(2, 6);
            options.strategy = strategy;
            const Picture picture = take_picture(test_device(), lit, camera, {across, across}, options);
            CHECK(picture.unusable == 0);
        }
}

TEST_CASE("path_invariance: no scene, no light, no pixels, and arrays that do not fit") {
    Device& device = test_device();
    const LitScene nothing(device, Scene{});
    const Camera camera = cornell_scene().cameras[0];
    const Picture dark = take_picture(device, nothing, camera, {3, 3}, seeded(1, 3));
    CHECK(*std::max_element(dark.direct.begin(), dark.direct.end()) == 0.0);
    Environment around;
    around.radiance = {1, 2, 3};
    const LitScene sky(device, Scene{}, around);
    const Picture bright = take_picture(device, sky, camera, {1, 1}, seeded(1, 3));
    CHECK(bright.direct == std::vector<double>{1, 2, 3});
    CHECK(bright.indirect == std::vector<double>{0, 0, 0});
    Scene unlit = cornell_scene();
    for (Material& material : unlit.materials) material.emission = glm::vec3(0.0f);
    const LitScene night(device, unlit);
    CHECK(take_picture(device, night, camera, {4, 4}, seeded(1, 3)).direct == std::vector<double>(48, 0.0));

    const Buffer<CameraRecord> record = upload_camera(device, camera, 2, 2);
    Buffer<Ray> rays = make_buffer<Ray>(device, 4, "rays");
    Buffer<Hit> hits = make_buffer<Hit>(device, 4, "hits");
    Buffer<float> light = make_buffer<float>(device, 12, "light");
    const LightOptions options;
    CHECK_THROWS_AS(trace_paths(device, night.world(), options, 0, {record, rays, hits, 0}, {light, light.prefix(9)}),
                    InputError);
    CHECK_THROWS_AS(trace_paths(device, night.world(), options, 0, {record, rays, hits.prefix(3), 0}, {light, light}),
                    InputError);
    trace_paths(device, night.world(), options, 0, {record, rays.prefix(0), hits.prefix(0), 0},
                {light.prefix(0), light.prefix(0)});
}
