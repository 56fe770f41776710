// SPDX-License-Identifier: MIT
// Whole queries against brute force, which shares the arithmetic: equal bits are asked for.
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "boxwood/build.hpp"
#include "oracles/brute_force.hpp"
#include "oracles/reference_builder.hpp"
#include "oracles/reference_obb.hpp"
#include "traverse/scenes.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("traverse");

namespace {

/// Closest hit, any hit, both lane twins and the statistics program of one scene, against brute force.
void check_all_queries(const Scene& scene, const std::vector<Ray>& rays, Shape shape = Shape::sah) {
    for (const Kind& kind : all_kinds) {
        CAPTURE(words(kind));
        const TreeImage tree = reference_tree(scene, kind.layout, kind.levels, kind.bounds, shape);
        const std::vector<Hit> expected = BruteForce(scene, kind.levels).closest_hits(rays);
        const std::vector<Hit> hits = trace(tree, rays);
        CHECK(count_different(hits, expected) == 0);
        std::vector<RayStatistics> statistics;
        CHECK(count_different(trace(tree, rays, statistics), expected) == 0);
        CHECK(count_different(trace(tree, rays, {.portable_lanes = true}), expected) == 0);
        for (const bool portable : {false, true}) {
            const std::vector<std::uint32_t> any = trace_any(tree, rays, {.portable_lanes = portable});
            std::size_t disagreeing = 0;
            for (std::size_t i = 0; i < rays.size(); ++i)
                disagreeing += any[i] != (expected[i].primitive == BOXWOOD_NONE ? 0u : 1u);
            CHECK(disagreeing == 0);
        }
    }
}

/// The same nodes in the layout of oriented boxes.
void align(std::vector<BinaryNode>& nodes, std::vector<OrientedNode>& oriented) {
    for (const BinaryNode& node : nodes) {
        OrientedNode& made = oriented.emplace_back();
        for (int slot = 0; slot < 2; ++slot) {
            std::copy_n(node.bounds[slot].min, 3, made.volume[slot]);
            std::copy_n(node.bounds[slot].max, 3, made.volume[slot] + 3);
            made.child[slot] = node.child[slot] | BOXWOOD_ALIGNED;
        }
    }
    nodes.clear();
}

std::uint32_t scaled_down(std::uint32_t size) { return small_sizes() ? std::max(size / 50, 8u) : size; }

} // namespace

TEST_CASE("traversal: equals brute force on random triangles") {
    // 1 to 9: partly filled leaves and nodes of both layouts; 1000: several levels.
    Random random(1);
    for (const std::uint32_t triangles : {1u, 2u, 3u, 4u, 5u, 8u, 9u, 33u, 1000u}) {
        CAPTURE(triangles);
        const Scene scene = single(random_mesh(random, scaled_down(triangles), triangles < 10 ? 0.8f : 0.2f));
        check_all_queries(scene, random_rays(random, scaled_down(1500), 1.0f));
    }
}

TEST_CASE("traversal: equals brute force on instances mirrored, stretched and sheared") {
    Random random(2);
    for (const std::uint32_t instances : {1u, 2u, 9u, 100u}) {
        CAPTURE(instances);
        const Scene scene = instanced_scene(random, 3, scaled_down(instances), scaled_down(60));
        check_all_queries(scene, random_rays(random, scaled_down(1500), 2.0f));
    }
}

TEST_CASE("traversal: every distance tied, the lowest primitive and instance win") {
    // A grid seen from above hits shared edges and vertices exactly; every triangle is there three times.
    Mesh grid;
    const std::uint32_t side = small_sizes() ? 2 : 8;
    for (std::uint32_t y = 0; y <= side; ++y)
        for (std::uint32_t x = 0; x <= side; ++x)
            grid.positions.emplace_back(static_cast<float>(x), static_cast<float>(y), 0.0f);
    for (int copy = 0; copy < 3; ++copy) {
        for (std::uint32_t y = 0; y < side; ++y) {
            for (std::uint32_t x = 0; x < side; ++x) {
                const std::uint32_t i = y * (side + 1) + x;
                grid.triangles.emplace_back(i, i + 1, i + side + 1);
                grid.triangles.emplace_back(i + 1, i + side + 2, i + side + 1);
            }
        }
    }
    Scene scene = single(grid);
    scene.instances.push_back({"again", 0, glm::mat4(1.0f)});
    scene.instances.push_back({"and again", 0, glm::mat4(1.0f)});
    std::vector<Ray> rays;
    for (std::uint32_t y = 0; y <= 2 * side; ++y)
        for (std::uint32_t x = 0; x <= 2 * side; ++x)
            for (const float direction : {-1.0f, 1.0f})
                rays.push_back({{0.5f * static_cast<float>(x), 0.5f * static_cast<float>(y), -4.0f * direction},
                                0.0f,
                                {0.0f, 0.0f, direction},
                                8.0f});
    check_all_queries(scene, rays);
    const TreeImage tree = reference_tree(scene, Layout::wide8, Levels::two);
    std::size_t hits = 0;
    for (const Hit& hit : trace(tree, rays)) {
        hits += hit.instance == 0 && hit.primitive < 2 * side * side && hit.t == 4.0f;
    }
    CHECK(hits == rays.size());
}

TEST_CASE("traversal: zero-area triangles are never hit, and do not hide others") {
    Random random(3);
    Mesh mesh = random_mesh(random, scaled_down(64), 0.5f);
    const auto add = [&](glm::vec3 a, glm::vec3 b, glm::vec3 c) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), {a, b, c});
        mesh.triangles.emplace_back(first, first + 1, first + 2);
    };
    const auto begin = static_cast<std::uint32_t>(mesh.triangles.size());
    const std::size_t count = mesh.triangles.size();
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 a = mesh.positions[3 * i], b = mesh.positions[3 * i + 1];
        add(a, a, a);
        add(a, b, b);
        add(a, b, a);
        add(a, a, b);
        add({0.0f, 0.0f, 0.0f}, a, 2.0f * a);
        add({0.0f, 0.0f, 0.0f}, 0.375f * a, a);
    }
    std::vector<Ray> rays = random_rays(random, scaled_down(1000), 1.0f);
    // Straight at the vertices, where all of them are.
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 d = mesh.positions[3 * i] - glm::vec3(2.0f);
        rays.push_back({{2.0f, 2.0f, 2.0f}, 0.0f, {d.x, d.y, d.z}, 4.0f});
    }
    const Scene scene = single(mesh);
    check_all_queries(scene, rays);
    for (const Hit& hit : trace(reference_tree(scene, Layout::wide8, Levels::one), rays))
        CHECK((hit.primitive == BOXWOOD_NONE || hit.primitive < begin));
}

TEST_CASE("traversal: the deepest tree fills the stack and no more") {
    // One triangle splits off at each level, and a ray from the far end goes down the whole chain before it comes back.
    // 65 triangles make 64 binary nodes, which fill a stack of 64 exactly.
    const std::uint32_t triangles = 65;
    Mesh mesh;
    for (std::uint32_t i = 0; i < triangles; ++i) {
        const auto x = static_cast<float>(i);
        mesh.positions.insert(mesh.positions.end(), {{x, -1.0f, -1.0f}, {x, 1.0f, -1.0f}, {x, 0.0f, 2.0f}});
        mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    const Scene scene = single(mesh);
    const TreeImage chain = reference_tree(scene, Layout::binary, Levels::one, Bounds::aabb, Shape::chain);
    CHECK(chain.bottom_depth == triangles - 1);
    std::vector<Ray> rays;
    const auto end = static_cast<float>(triangles);
    const int rows = small_sizes() ? 2 : 40;
    for (int i = 0; i < rows; ++i) {
        const float z = 2.0f / static_cast<float>(rows) * static_cast<float>(i) - 1.0f;
        rays.push_back({{-1.0f, 0.0f, z}, 0.0f, {1.0f, 0.0f, 0.0f}, end + 2.0f});
        rays.push_back({{end, 0.0f, z}, 0.0f, {-1.0f, 0.0f, 0.0f}, end + 2.0f});
        // Through all boxes, past all triangles: nothing shortens the ray.
        rays.push_back({{-1.0f, 0.99f, 1.5f}, 0.0f, {1.0f, 0.0f, 0.0f}, end + 2.0f});
    }
    check_all_queries(scene, rays, Shape::chain);
}

TEST_CASE("traversal: built trees that are as deep as builders make them") {
    // Each triangle more than twice as far and as large as the one before: halves in space part off one at a time, and
    // what is left below max_levels of 100 is halved by number.
    Mesh mesh;
    std::vector<Ray> rays;
    for (double at = 0x1p-60; at < 0x1p58; at *= 2.1) {
        const auto x = static_cast<float>(at);
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), {{x, -x, -x}, {x, x, -x}, {x, 0.0f, 2.0f * x}});
        mesh.triangles.emplace_back(first, first + 1, first + 2);
        if (small_sizes() && mesh.triangles.size() % 20 != 0) continue;
        const float t_max = std::numeric_limits<float>::infinity();
        for (const float way : {-1.0f, 1.0f}) rays.push_back({{1.5f * x, 0.0f, 0.0f}, 0.0f, {way, 0.0f, 0.0f}, t_max});
    }
    const Scene scene = single(mesh);
    const std::vector<Hit> expected = BruteForce(scene, Levels::one).closest_hits(rays);
    for (const Builder builder : {Builder::sah, Builder::midpoint}) {
        for (const Layout layout : {Layout::binary, Layout::wide8}) {
            const TreeImage tree = download(test_device(), build(test_device(), scene, {Levels::one, layout, builder}));
            CHECK_NOTHROW(validate(tree, scene, "tree"));
            if (builder == Builder::midpoint && layout == Layout::binary)
                CHECK(tree.bottom_depth == 100 + std::bit_width(mesh.triangles.size() - 101));
            CHECK(count_different(trace(tree, rays), expected) == 0);
            const std::vector<std::uint32_t> any = trace_any(tree, rays);
            for (std::size_t i = 0; i < rays.size(); ++i)
                CHECK(any[i] == (expected[i].primitive == BOXWOOD_NONE ? 0u : 1u));
        }
    }
}

TEST_CASE("traversal: empty trees and no rays") {
    const std::vector<Ray> ray{{{0, 0, 0}, 0, {1, 0, 0}, 1}};
    for (const Kind& kind : all_kinds) {
        const TreeImage empty = reference_tree({}, kind.layout, kind.levels, kind.bounds);
        std::vector<RayStatistics> statistics;
        const Hit hit = trace(empty, ray, statistics).at(0);
        CHECK(hit.t == std::numeric_limits<float>::infinity());
        CHECK(hit.primitive == BOXWOOD_NONE);
        CHECK(hit.instance == BOXWOOD_NONE);
        CHECK(statistics.at(0).volumes == 0);
        CHECK(trace_any(empty, ray).at(0) == 0);
        Random random(4);
        const TreeImage tree =
            reference_tree(single(random_mesh(random, 9, 0.5f)), kind.layout, kind.levels, kind.bounds);
        CHECK(trace(tree, {}).empty());
        CHECK(trace_any(tree, {}).empty());
    }
}

TEST_CASE("traversal: a tree of aligned volumes costs what the same binary tree costs") {
    Random random(6);
    const Scene scene = instanced_scene(random, 2, 8, 40);
    const std::vector<Ray> rays = random_rays(random, scaled_down(1000), 2.0f);
    for (const Levels levels : {Levels::one, Levels::two}) {
        TreeImage tree = reference_tree(scene, Layout::binary, levels);
        std::vector<RayStatistics> expected, found;
        const std::vector<Hit> hits = trace(tree, rays, expected);
        tree.bounds = Bounds::obb_points;
        align(tree.binary_nodes, tree.oriented_nodes);
        align(tree.binary_top, tree.oriented_top);
        CHECK(count_different(trace(tree, rays, found), hits) == 0);
        CHECK(same_bits(found, expected));
    }
    // One triangle in one oriented box: one volume, which the second ray does not enter.
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    TreeImage one = reference_tree(single(mesh), Layout::binary, Levels::one, Bounds::obb_points);
    OrientedNode& node = one.oriented_nodes.at(0);
    node.child[0] &= ~BOXWOOD_ALIGNED;
    store_volume(box_around(random_rows(random, false), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), node.volume[0]);
    std::vector<RayStatistics> statistics;
    trace(one, {{{0.2f, 0.2f, -1}, 0, {0, 0, 1}, 2}, {{2, 2, -1}, 0, {0, 0, 1}, 2}}, statistics);
    CHECK(statistics[0].volumes == 1);
    CHECK(statistics[0].primitives == 1);
    CHECK(statistics[1].volumes == 1);
    CHECK(statistics[1].primitives == 0);
}

TEST_CASE("traversal: the same for every group size") {
    Random random(5);
    const Scene scene = instanced_scene(random, 2, 8, 40);
    // Not a multiple of any group, and more than one slice.
    const std::vector<Ray> rays = random_rays(random, scaled_down(777), 2.0f);
    const Tuning before = test_device().tuning();
    for (const Kind& kind : all_kinds) {
        const TreeImage tree = reference_tree(scene, kind.layout, kind.levels, kind.bounds);
        test_device().set_tuning({1, 4, 16});
        const std::vector<Hit> alone = trace(tree, rays);
        test_device().set_tuning({64, 128, 1});
        CHECK(count_different(trace(tree, rays), alone) == 0);
        test_device().set_tuning(before);
    }
}
