// SPDX-License-Identifier: MIT
// Triangle tests against double precision, at all scales, and rays that are not valid.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "oracles/brute_force.hpp"
#include "oracles/reference_builder.hpp"
#include "traverse/scenes.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("traverse");

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// The scene and rays with all lengths times 2^k; directions are lengths too, so t stays.
Scene scaled(Scene scene, int k) {
    for (Mesh& mesh : scene.meshes)
        for (glm::vec3& p : mesh.positions) p = glm::vec3(std::ldexp(p.x, k), std::ldexp(p.y, k), std::ldexp(p.z, k));
    for (Instance& instance : scene.instances)
        for (int row = 0; row < 3; ++row) instance.transform[3][row] = std::ldexp(instance.transform[3][row], k);
    return scene;
}

std::vector<Ray> scaled(std::vector<Ray> rays, int k) {
    for (Ray& ray : rays)
        for (int axis = 0; axis < 3; ++axis) {
            ray.origin[axis] = std::ldexp(ray.origin[axis], k);
            ray.direction[axis] = std::ldexp(ray.direction[axis], k);
        }
    return rays;
}

} // namespace

TEST_CASE("ray_triangle: brute force: of many triangles, the hit that double precision finds among all") {
    // Clusters, so that most blocks of triangles are far from a ray, and instances that are turned, stretched and
    // mirrored.
    Random random(22);
    Scene scene = instanced_scene(random, 2, small_sizes() ? 2 : 5, 0);
    for (Mesh& mesh : scene.meshes) {
        mesh = {};
        for (std::uint32_t cluster = 0; cluster < 8; ++cluster) {
            const glm::vec3 middle(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
            for (const glm::vec3& p : random_mesh(random, 128, 0.3f).positions)
                mesh.positions.push_back(middle + 0.2f * p);
        }
        for (std::uint32_t i = 0; i < mesh.positions.size(); i += 3) mesh.triangles.emplace_back(i, i + 1, i + 2);
    }
    std::vector<Ray> rays = random_rays(random, small_sizes() ? 200 : 1000, 2.0f);
    std::vector<std::array<glm::vec3, 3>> all;
    for (const Instance& instance : scene.instances)
        for (const auto& triangle : world_corners(scene, instance)) all.push_back(triangle);
    for (std::size_t i = 0; i < rays.size(); i += 2) {
        const auto& [v0, v1, v2] = all[random.below(static_cast<std::uint32_t>(all.size()))];
        for (int axis = 0; axis < 3; ++axis) {
            const float middle = (v0[axis] + v1[axis] + v2[axis]) / 3.0f;
            rays[i].direction[axis] = middle - rays[i].origin[axis];
        }
    }
    const BruteForce one(scene, Levels::one), two(scene, Levels::two);
    std::size_t hits = 0, wrong = 0;
    for (const Ray& ray : rays) {
        // The closest, and the closest of those that roundings at edges cannot take away.
        double closest = ray.t_max, safe = ray.t_max;
        for (const auto& triangle : all) {
            const auto exact = intersect_in_double(ray, triangle);
            if (!exact) continue;
            const auto [t, u, v] = *exact;
            if (t <= double{ray.t_min} * (1 - 1e-4) || t > double{ray.t_max}) continue;
            closest = std::min(closest, t);
            if (std::min({u, v, 1 - u - v}) > 1e-3 && t > double{ray.t_min} * (1 + 1e-4)) safe = std::min(safe, t);
        }
        for (const BruteForce* brute : {&one, &two}) {
            const Hit hit = brute->closest_hit(ray);
            hits += hit.primitive != BOXWOOD_NONE;
            wrong += hit.t < closest * (1 - 1e-4) || (safe < ray.t_max * (1 - 1e-4) && hit.t > safe * (1 + 1e-4));
        }
    }
    CHECK(hits > rays.size() / 4);
    CHECK(wrong == 0);
}

TEST_CASE("ray_triangle: agrees with double precision") {
    Random random(20);
    const std::uint32_t count = small_sizes() ? 100 : 4000;
    const std::vector<Ray> rays = random_rays(random, count, 1.0f);
    const Mesh mesh = random_mesh(random, 1, 0.9f);
    const std::array<glm::vec3, 3> triangle = corners(mesh)[0];
    for (const Layout layout : {Layout::binary, Layout::wide8}) {
        const std::vector<Hit> hits = trace(reference_tree(single(mesh), layout, Levels::one), rays);
        std::size_t both = 0, wrong = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const auto exact = intersect_in_double(rays[i], triangle);
            const bool inside = exact && (*exact)[0] > rays[i].t_min && (*exact)[0] <= rays[i].t_max;
            const bool hit = hits[i].primitive != BOXWOOD_NONE;
            if (hit && inside) {
                ++both;
                // Rays come from up to 4 away and may graze: a few hundred units of float.
                wrong += std::fabs(hits[i].t - (*exact)[0]) > 1e-4 * (*exact)[0];
                wrong += std::fabs(hits[i].u - (*exact)[1]) > 1e-4 || std::fabs(hits[i].v - (*exact)[2]) > 1e-4;
            } else if (hit != inside) {
                // Only a ray on the border of the triangle or of its interval may be judged differently.
                const bool border =
                    exact &&
                    (std::min({(*exact)[1], (*exact)[2], 1 - (*exact)[1] - (*exact)[2]}) < 1e-5 ||
                     std::fabs((*exact)[0] - rays[i].t_min) < 1e-5 || std::fabs((*exact)[0] - rays[i].t_max) < 1e-5);
                wrong += exact && !border;
                wrong += !exact && std::min({hits[i].u, hits[i].v, 1 - hits[i].u - hits[i].v}) > 1e-5f;
            }
        }
        CHECK(both > count / 40);
        CHECK(wrong == 0);
    }
}

TEST_CASE("ray_triangle: traversal: a scene times 2^k gives the same bits") {
    Random random(21);
    const Scene scene = instanced_scene(random, 2, small_sizes() ? 3u : 20u, small_sizes() ? 10u : 60u);
    const std::vector<Ray> rays = random_rays(random, small_sizes() ? 40u : 1000u, 2.0f);
    for (const Kind& kind : all_kinds) {
        CAPTURE(words(kind));
        const std::vector<Hit> expected = trace(reference_tree(scene, kind.layout, kind.levels, kind.bounds), rays);
        for (const int k : {-40, -17, 1, 23, 40}) {
            CAPTURE(k);
            const TreeImage tree = reference_tree(scaled(scene, k), kind.layout, kind.levels, kind.bounds);
            CHECK(count_different(trace(tree, scaled(rays, k)), expected) == 0);
        }
    }
}

TEST_CASE("ray_triangle: traversal: directions of any length, t in their units") {
    Random random(22);
    const Scene scene = single(random_mesh(random, 200, 0.4f));
    std::vector<Ray> rays = random_rays(random, small_sizes() ? 40u : 400u, 1.0f);
    for (Ray& ray : rays) ray.t_min = 0.0f, ray.t_max = infinity;
    for (const Kind& kind : all_kinds) {
        const TreeImage tree = reference_tree(scene, kind.layout, kind.levels, kind.bounds);
        const std::vector<Hit> expected = trace(tree, rays);
        // 2^100 and 2^-100 would over- and underflow in products of a direction and two edges. At 2^-140 directions
        // keep fewer bits, so only that something is hit and nothing is NaN can be asked for.
        for (const int k : {-100, -60, 60, 100}) {
            std::vector<Ray> longer = rays;
            for (Ray& ray : longer)
                for (float& component : ray.direction) component = std::ldexp(component, k);
            std::vector<Hit> hits = trace(tree, longer);
            for (Hit& hit : hits) hit.t = std::ldexp(hit.t, k);
            CHECK(count_different(hits, expected) == 0);
        }
        std::vector<Ray> tiny = rays;
        for (Ray& ray : tiny)
            for (float& component : ray.direction) component = std::ldexp(component, -140);
        for (const Hit& hit : trace(tree, tiny)) CHECK_FALSE(std::isnan(hit.t));
    }
}

TEST_CASE("ray_triangle: traversal: rays that are not valid hit nothing") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const Ray good{{0.2f, 0.2f, -1}, 0, {0, 0, 1}, 2};
    std::vector<Ray> rays{good};
    for (const float bad : {nan, infinity, -infinity}) {
        for (int axis = 0; axis < 3; ++axis) {
            rays.push_back(good), rays.back().origin[axis] = bad;
            rays.push_back(good), rays.back().direction[axis] = bad;
        }
        rays.push_back(good), rays.back().t_min = bad;
    }
    rays.push_back(good), rays.back().t_max = nan;
    rays.push_back(good), rays.back().t_max = -infinity;
    rays.push_back(good), rays.back().t_min = -1.0f;
    rays.push_back(good), rays.back().t_min = 3.0f;
    rays.push_back(good), rays.back().direction[2] = 0.0f;
    rays.push_back(good), rays.back().direction[2] = -0.0f;
    // t_min < t <= t_max: the triangle at exactly 1 is outside one interval and inside the other.
    rays.push_back(good), rays.back().t_min = 1.0f;
    rays.push_back(good), rays.back().t_max = 1.0f;
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    for (const Kind& kind : all_kinds) {
        const TreeImage tree = reference_tree(single(mesh), kind.layout, kind.levels, kind.bounds);
        const std::vector<Hit> hits = trace(tree, rays);
        const std::vector<std::uint32_t> any = trace_any(tree, rays);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            CAPTURE(i);
            const bool expected = i == 0 || i + 1 == rays.size();
            CHECK((hits[i].primitive == 0) == expected);
            CHECK(hits[i].t == (expected ? 1.0f : infinity));
            CHECK(any[i] == (expected ? 1u : 0u));
        }
        CHECK(count_different(hits, BruteForce(single(mesh), kind.levels).closest_hits(rays)) == 0);
    }
}
