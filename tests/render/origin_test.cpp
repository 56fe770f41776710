// SPDX-License-Identifier: MIT
// Origins by a bound of the errors (render/surface.h) beside the steps of Waechter and Binder 2019 ("A Fast and Robust
// Method for Avoiding Self-Intersection"), which fit scenes of about unit size.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "boxwood/build.hpp"
#include "boxwood/geometry.hpp"
#include "boxwood/rays.hpp"
#include "boxwood/trace.hpp"
#include "path_scenes.hpp"
#include "runtime/launch.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

namespace {

/// A mesh of unit size, scaled in its vertices or by its transform, and moved by `offset` times the scale.
Scene placed(const Mesh& mesh, float scale, float offset, bool by_transform) {
    Scene scene;
    scene.meshes = {mesh};
    scene.instances = {{"it", 0, glm::mat4(1.0f)}};
    const glm::vec3 away = scale * offset * glm::vec3(1.0f, -0.7f, 0.3f);
    if (by_transform) {
        scene.instances[0].transform =
            glm::scale(glm::rotate(glm::mat4(1.0f), 0.6f, {0.6f, 0.0f, 0.8f}), glm::vec3(scale));
        scene.instances[0].transform[3] = glm::vec4(away, 1.0f);
    } else {
        for (glm::vec3& p : scene.meshes[0].positions) p = scale * p + away;
    }
    return scene;
}

struct Counts {
    std::size_t rays = 0;
    std::size_t wrong[2] = {0, 0}; ///< By error bound, by steps.
};

/// Rays that leave points which rays from `from` met. Outside a convex body each that hits anything hits where it comes
/// from; inside a closed one each that misses has leaked.
Counts count_wrong(const Scene& scene, const BuildOptions& options, const glm::dvec3& from, double reach, bool inside) {
    Device& device = test_device();
    const Tree tree = build(device, scene, options);
    const Geometry geometry = upload(device, scene);
    const std::uint32_t count = small_sizes() ? 16 : 1024;
    Random random(5);
    const auto draw = [&random] {
        const float x = random.uniform(-1, 1), y = random.uniform(-1, 1), z = random.uniform(-1, 1);
        return glm::vec3(x, y, z);
    };
    std::vector<Ray> first;
    std::vector<float> directions;
    const glm::mat4& transform = scene.instances[0].transform;
    const Mesh& mesh = scene.meshes[0];
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::vec3 corner = mesh.positions[mesh.triangles[random.below(std::uint32_t(mesh.triangles.size()))].x];
        const glm::dvec3 target(transform * glm::vec4(corner, 1.0f));
        const glm::dvec3 origin = from + 0.01 * reach * glm::dvec3(draw());
        const glm::vec3 direction = glm::normalize(target + 0.05 * reach * glm::dvec3(draw()) - origin);
        first.push_back({{float(origin.x), float(origin.y), float(origin.z)},
                         0.0f,
                         {direction.x, direction.y, direction.z},
                         std::numeric_limits<float>::infinity()});
        const glm::vec3 next = glm::normalize(draw());
        directions.insert(directions.end(), {next.x, next.y, next.z});
    }
    const Buffer<Ray> rays = upload(device, first, "rays");
    Buffer<Hit> hits = make_buffer<Hit>(device, count, "hits"), next_hits = make_buffer<Hit>(device, count, "hits");
    closest_hit(device, tree, rays, hits);
    const std::vector<Hit> met = download(device, hits);
    Counts counts;
    for (std::uint32_t steps = 0; steps < 2; ++steps) {
        Buffer<Ray> next = make_buffer<Ray>(device, count, "next rays");
        launch(device, {"render/origin_test.cl", "origin_test", {{"LANES", "1"}, {"TRANSFORMS", "1"}}}, "origin test",
               count, geometry.positions, geometry.triangles, geometry.meshes, geometry.instances, rays, hits,
               upload(device, directions, "directions"), count, steps, next);
        closest_hit(device, tree, next, next_hits);
        const std::vector<Hit> found = download(device, next_hits);
        counts.rays = 0;
        for (std::size_t i = 0; i < count; ++i) {
            if (met[i].primitive == BOXWOOD_NONE) continue;
            ++counts.rays;
            if ((found[i].primitive == BOXWOOD_NONE) == inside) ++counts.wrong[steps];
        }
    }
    return counts;
}

} // namespace

TEST_CASE(
    "origin: no ray meets the surface that it leaves nor leaks, at any scale and place; integer steps fail at some") {
    Mesh plane{"plane", {}, {}};
    const std::uint32_t cells = 16;
    for (std::uint32_t j = 0; j <= cells; ++j)
        for (std::uint32_t i = 0; i <= cells; ++i)
            plane.positions.emplace_back(float(i) / 8 - 1, 0.1f, float(j) / 8 - 1);
    for (std::uint32_t j = 0; j < cells; ++j)
        for (std::uint32_t i = 0; i < cells; ++i) {
            const std::uint32_t a = j * (cells + 1) + i, b = a + cells + 1;
            plane.triangles.emplace_back(a, b, a + 1);
            plane.triangles.emplace_back(a + 1, b, b + 1);
        }
    // Products of edges of 2^-63, of which a finer sphere's would be, are the least that are not denormal: triangles
    // without area.
    const Mesh fine = sphere_mesh(small_sizes() ? 6 : 24, false), coarse = sphere_mesh(6, false);
    std::size_t rays = 0, by_steps[3] = {0, 0, 0};
    for (const int k :
         small_sizes() ? std::vector<int>{-60, 60} : std::vector<int>{-60, -40, -20, -8, 0, 8, 20, 40, 60})
        for (const float offset : {0.0f, 16.0f, 1024.0f})
            for (const bool by_transform : {false, true}) {
                CAPTURE(k);
                CAPTURE(offset);
                CAPTURE(by_transform);
                const float scale = std::ldexp(1.0f, k);
                const Mesh& sphere = k == -60 ? coarse : fine;
                const glm::dvec3 middle = double(scale) * offset * glm::dvec3(1, -0.7, 0.3);
                const glm::dvec3 outside = middle + 3.0 * double(scale) * glm::normalize(glm::dvec3(1, 2, 1));
                const BuildOptions options{.levels = by_transform ? Levels::two : Levels::one};
                const Counts counts[3] = {
                    count_wrong(placed(plane, scale, offset, by_transform), options, outside, scale, false),
                    count_wrong(placed(sphere, scale, offset, by_transform), options, outside, scale, false),
                    count_wrong(placed(sphere, scale, offset, by_transform), options, middle, scale, true)};
                // Rays along triangles of 2^-61 miss them, for the reciprocal of their determinant is infinite.
                const bool lost = k == -60 && !by_transform;
                for (int c = 0; c < (lost ? 2 : 3); ++c) {
                    CAPTURE(c);
                    CHECK(counts[c].rays > 0);
                    CHECK(counts[c].wrong[0] == 0);
                    rays += counts[c].rays;
                    by_steps[c] += counts[c].wrong[1];
                }
            }
    MESSAGE("of ", rays, " rays, by integer steps ", by_steps[0], " meet their plane, ", by_steps[1],
            " their sphere, and ", by_steps[2], " leak out of it; by the error bound none");
    CHECK(by_steps[0] + by_steps[1] + by_steps[2] > 0);
}
