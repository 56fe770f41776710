// SPDX-License-Identifier: MIT
// Closed surfaces have no gaps.
#include <doctest/doctest.h>

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "render/both_hits.hpp"
#include "support.hpp"
#include "traverse/scenes.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

namespace {

/// A picture whose pixels have their centres at odd multiples of half a unit, exactly: unit pixels, width x height,
/// through an orthographic camera that looks down -z from z = 10.
Camera unit_camera(std::uint32_t height) {
    Camera camera;
    camera.to_world = glm::translate(glm::mat4(1.0f), {0.0f, 0.0f, 10.0f});
    camera.perspective = false;
    camera.half_height = 0.5f * static_cast<float>(height);
    return camera;
}

void split(Mesh& mesh, std::size_t triangle, const glm::vec3& point) {
    const glm::uvec3 t = mesh.triangles[triangle];
    const auto vertex = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back(point);
    mesh.triangles[triangle] = {t.x, t.y, vertex};
    mesh.triangles.push_back({t.y, t.z, vertex});
    mesh.triangles.push_back({t.z, t.x, vertex});
}

/// A rectangle from -reach to reach in x and y at z = 0, split again and again at points that `choose` takes from the
/// corners of a triangle: a surface without holes, whatever the points are.
template <class Choose>
Mesh patch(glm::vec2 reach, std::size_t triangles, Random& random, const Choose& choose) {
    Mesh mesh;
    mesh.positions = {{-reach.x, -reach.y, 0}, {reach.x, -reach.y, 0}, {reach.x, reach.y, 0}, {-reach.x, reach.y, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    while (mesh.triangles.size() < triangles) {
        const std::size_t i = random.below(static_cast<std::uint32_t>(mesh.triangles.size()));
        const glm::uvec3 t = mesh.triangles[i];
        split(mesh, i, choose(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]));
    }
    return mesh;
}

void check_filled(const Scene& scene, const Camera& camera, std::uint32_t width, std::uint32_t height,
                  glm::vec2 jitter) {
    for (const BuildOptions& options : tree_options()) {
        const BothHits both = both_hits(test_device(), scene, options, camera, width, height, jitter);
        std::size_t missed = 0;
        for (const Hit& hit : both.drawn) missed += hit.primitive == BOXWOOD_NONE;
        CHECK(missed == 0);
        CHECK(both.different() == 0);
    }
}

} // namespace

TEST_CASE("raster_coverage: every pixel of a closed surface has a triangle, also on edges and corners") {
    // Three tiles by two. Corners of the triangles are pixel centres (jitter 0), or corners of pixels.
    const std::uint32_t width = small_sizes() ? 18 : 48, height = small_sizes() ? 4 : 32;
    Random random(310);
    const std::size_t triangles = small_sizes() ? 16 : 400;
    // On the grid of pixel centres: whole numbers and a half, never outside of the triangle but often on its edges.
    const auto on_grid = [&](glm::vec3 a, glm::vec3 b, glm::vec3 c) {
        const glm::vec3 inside = (a + b + c) / 3.0f;
        return glm::vec3(std::floor(inside.x) + 0.5f, std::floor(inside.y) + 0.5f, 0.0f);
    };
    // Anywhere inside, so that after some splits there are needles and triangles far smaller than a pixel.
    const auto anywhere = [&](glm::vec3 a, glm::vec3 b, glm::vec3 c) {
        float u = random.uniform(0, 1), v = random.uniform(0, 1);
        if (u + v > 1.0f) u = 1.0f - u, v = 1.0f - v;
        return a + u * (b - a) + v * (c - a);
    };
    // On an edge, rounded: a triangle without area, or turned over.
    const auto on_edge = [&](glm::vec3 a, glm::vec3 b, glm::vec3) { return a + random.uniform(0, 1) * (b - a); };
    const glm::vec2 reach(static_cast<float>(width / 2) + 0.5f, static_cast<float>(height / 2) + 0.5f);
    for (int kind = 0; kind < 3; ++kind)
        for (const glm::vec2 jitter : {glm::vec2(0.0f), glm::vec2(0.999f, -0.999f)}) {
            CAPTURE(kind);
            const Mesh mesh = kind == 0   ? patch(reach, triangles, random, on_grid)
                              : kind == 1 ? patch(reach, triangles, random, anywhere)
                                          : patch(reach, triangles, random, on_edge);
            const Scene scene = single(mesh);
            check_filled(scene, unit_camera(height), width, height, jitter);
            // The same in perspective, from a place where nothing falls on a pixel's centre but the middle.
            Camera perspective = unit_camera(height);
            perspective.perspective = true;
            perspective.vertical_fov = 1.0f;
            perspective.to_world = glm::translate(glm::mat4(1.0f), {0.3f, -0.2f, 0.625f * static_cast<float>(height)});
            check_filled(scene, perspective, width, height, jitter);
        }
}

TEST_CASE("raster_coverage: triangles through the plane of the eye") {
    // A floor under the eye and far around it: below the horizon all pixels, above it none. Nearer than 17 roundoffs of
    // its triangles' extents, 0.06, a ray could not tell on which side of them it starts.
    const std::uint32_t width = 50, height = 40;
    Random random(311);
    const auto anywhere = [&](glm::vec3 a, glm::vec3 b, glm::vec3 c) {
        return 0.4f * a + 0.35f * b + random.uniform(0.2f, 0.3f) * c;
    };
    Mesh mesh = patch({3e4f, 3e4f}, small_sizes() ? 20 : 200, random, anywhere);
    Scene scene = single(std::move(mesh));
    scene.instances[0].transform = glm::rotate(glm::mat4(1.0f), -1.5707964f, {1, 0, 0});
    Camera camera;
    camera.vertical_fov = 1.2f;
    for (const float height_above : {1.0f, 0.1f}) {
        camera.to_world = glm::translate(glm::mat4(1.0f), {0.2f, height_above, 0.1f});
        for (const BuildOptions& options : tree_options()) {
            const BothHits both = both_hits(test_device(), scene, options, camera, width, height);
            for (std::uint32_t i = 0; i < width * height; ++i) {
                CAPTURE(i);
                REQUIRE((both.drawn[i].primitive != BOXWOOD_NONE) == (i / width >= height / 2));
            }
            CHECK(both.different() == 0);
        }
    }
}

TEST_CASE("raster_coverage: no gaps where edges round") {
    // Triangles of a fraction of a pixel, on a slope away from the origin, so that edges round.
    Random random(314);
    const std::uint32_t width = small_sizes() ? 20 : 150, height = small_sizes() ? 10 : 100;
    const auto anywhere = [&](glm::vec3 a, glm::vec3 b, glm::vec3 c) {
        float u = random.uniform(0, 1), v = random.uniform(0, 1);
        if (u + v > 1.0f) u = 1.0f - u, v = 1.0f - v;
        return a + u * (b - a) + v * (c - a);
    };
    Mesh mesh = patch({100.0f, 100.0f}, small_sizes() ? 10 : 40000, random, anywhere);
    for (glm::vec3& p : mesh.positions) p += glm::vec3(777.0f, -333.0f, 0.3f * p.x + 0.1f * p.y);
    const Scene scene = single(std::move(mesh));
    Camera camera;
    camera.to_world = glm::translate(glm::mat4(1.0f), {777.0f, -333.0f, 60.0f});
    const BothHits both = both_hits(test_device(), scene, BuildOptions{}, camera, width, height);
    std::size_t traced = 0, drawn = 0;
    for (const Hit& hit : both.traced) traced += hit.primitive == BOXWOOD_NONE;
    for (const Hit& hit : both.drawn) drawn += hit.primitive == BOXWOOD_NONE;
    CHECK(traced == 0);
    CHECK(drawn == 0);
    CHECK(count_different(both.drawn, both.traced) == 0);
}

TEST_SUITE_END();
