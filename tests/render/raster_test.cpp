// SPDX-License-Identifier: MIT
// The rasteriser against rays.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>

#include <glm/gtc/matrix_transform.hpp>

#include "boxwood/error.hpp"
#include "boxwood/gltf.hpp"
#include "boxwood/procedural.hpp"
#include "render/both_hits.hpp"
#include "render/camera.hpp"
#include "support.hpp"
#include "traverse/scenes.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

TEST_CASE("raster: the hits of rays, on every procedural scene and kind of tree") {
    // Two tiles and a part of one across and down.
    const std::uint32_t width = small_sizes() ? 20 : 150, height = small_sizes() ? 9 : 91;
    for (const ProceduralKind& kind : procedural_kinds()) {
        CAPTURE(kind.name);
        const Scene scene = make_procedural(kind.name, {small_sizes() ? 100u : 3000u, 5, 3});
        for (const BuildOptions& options : tree_options()) {
            const Camera& camera = scene.cameras.at(0);
            const BothHits both = both_hits(test_device(), scene, options, camera, width, height, {0.37f, -0.81f});
            if (!small_sizes()) CHECK(both.hits() > 0);
            CHECK(both.different() == 0);
        }
    }
}

TEST_CASE("raster: cameras inside of geometry, orthographic ones, and scenes of any scale") {
    Random random(312);
    const std::uint32_t width = small_sizes() ? 18 : 120, height = small_sizes() ? 12 : 75;
    for (const int exponent : {0, -60, 58}) {
        Scene scene = instanced_scene(random, 3, small_sizes() ? 3 : 12, small_sizes() ? 20 : 150);
        const float scale = std::ldexp(1.0f, exponent);
        // Scaled exactly: positions and places, so that the trees of one level and of two are.
        for (Mesh& mesh : scene.meshes)
            for (glm::vec3& p : mesh.positions) p *= scale;
        for (Instance& instance : scene.instances)
            for (int k = 0; k < 3; ++k) instance.transform[3][k] *= scale;
        CAPTURE(exponent);
        for (const bool perspective : {true, false}) {
            Camera camera;
            camera.perspective = perspective;
            camera.half_height = 2.0f * scale;
            camera.to_world = glm::rotate(glm::mat4(1.0f), 0.7f, glm::normalize(glm::vec3(1, 2, 3)));
            camera.to_world[3] = glm::vec4(0.2f * scale, 0.1f * scale, 0.3f * scale, 1.0f);
            for (const BuildOptions& options : tree_options()) {
                const BothHits both = both_hits(test_device(), scene, options, camera, width, height, {-0.25f, 0.5f});
                CHECK(both.hits() > 0);
                CHECK(both.different() == 0);
            }
        }
    }
}

TEST_CASE("raster: a part of a picture is that part of it, and many triangles the same as few at once") {
    Device& device = test_device();
    const Scene scene = make_procedural("menger", {small_sizes() ? 200u : 4000u, 0, 1});
    const std::uint32_t width = 61, height = 45;
    const Tree tree = build(device, scene);
    const Geometry geometry = upload(device, scene);
    const Rasteriser rasteriser(device, scene, tree, geometry);
    const Buffer<CameraRecord> camera = upload_camera(device, scene.cameras.at(0), width, height);
    const auto part = [&](std::uint32_t first, std::uint32_t count) {
        Buffer<Ray> rays = make_buffer<Ray>(device, count, "rays");
        const Guarded<Hit> hits(device, count);
        primary_rays(device, camera, first, rays);
        rasteriser.draw(camera, width, height, first, rays, hits.view());
        CHECK(hits.intact());
        return hits.values();
    };
    const std::vector<Hit> all = part(0, width * height);
    // One pixel; parts of a row, of two rows, of rows that tiles cut; the last pixel; none.
    for (const auto& [first, count] :
         {std::pair<std::uint32_t, std::uint32_t>{700, 1}, {620, 30}, {600, 70}, {333, 1999}, {61 * 45 - 1, 1}, {5, 0}})
        CHECK(same_bits(part(first, count), std::vector<Hit>(all.begin() + first, all.begin() + first + count)));
    Buffer<Ray> rays = make_buffer<Ray>(device, 2, "rays");
    Buffer<Hit> hits = make_buffer<Hit>(device, 2, "hits");
    CHECK_THROWS_AS(rasteriser.draw(camera, width, height, width * height - 1, rays, hits), InputError);
    CHECK_THROWS_AS(rasteriser.draw(camera, 0, height, 0, rays, hits), InputError);
    CHECK_THROWS_AS(rasteriser.draw(camera, width, 0, 0, rays, hits), InputError);
    CHECK_THROWS_AS(rasteriser.draw(camera, width, height, 0, rays, hits.prefix(1)), InputError);
    CHECK_THROWS_AS(rasteriser.draw(camera, 1u << 23, 1u << 23, 0, rays, hits), InputError);
    CHECK_NOTHROW(rasteriser.draw(camera, 0, 0, 0, rays.prefix(0), hits.prefix(0)));
}

TEST_CASE("raster: nothing to draw, and triangles that nobody sees") {
    Device& device = test_device();
    Scene scene;
    Camera camera;
    camera.to_world = glm::translate(glm::mat4(1.0f), {0.0f, 0.0f, 3.0f});
    for (int step = 0; step < 3; ++step) {
        if (step == 1) { // behind the eye; without area; seen from the edge; a point
            Mesh mesh;
            mesh.positions = {{0, 0, 5}, {1, 0, 5}, {0, 1, 5}, {-1, 0, 0}, {1, 0, 0},
                              {3, 0, 0}, {0, 0, 0}, {0, 0, 1}, {0, 1, 0}};
            mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {3, 3, 3}};
            scene = single(mesh);
        }
        if (step == 2) camera.perspective = false;
        const BothHits both = both_hits(device, scene, BuildOptions{}, camera, 5, 3);
        for (const Hit& hit : both.drawn) {
            CHECK(hit.primitive == BOXWOOD_NONE);
            CHECK(hit.instance == BOXWOOD_NONE);
            CHECK(std::isinf(hit.t));
            CHECK((hit.u == 0.0f && hit.v == 0.0f));
        }
    }
}

TEST_CASE("raster: the hits of rays on every real scene") {
    if (scenes_folder().empty() || small_sizes()) {
        MESSAGE("skipped: real scenes (BOXWOOD_SCENES is not set, or sizes are kept small)");
        return;
    }
    for (const auto& entry : std::filesystem::directory_iterator(scenes_folder())) {
        if (entry.path().extension() != ".glb") continue;
        CAPTURE(entry.path().filename().string());
        const Scene scene = load_gltf(entry.path());
        const Camera camera = scene.cameras.empty() ? default_camera(scene) : scene.cameras[0];
        const BothHits both = both_hits(test_device(), scene, BuildOptions{}, camera, 256, 256);
        CHECK(both.different() == 0);
    }
}

TEST_SUITE_END();
