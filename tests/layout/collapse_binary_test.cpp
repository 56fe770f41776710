// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

#include "boxwood/collapse.hpp"
#include "build/built_trees.hpp"
#include "shared/types.h"
#include "support.hpp"
#include "tuning.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("layout");

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr Aabb empty{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};

bool equal(const Aabb& a, const Aabb& b) {
    return std::equal(a.min, a.min + 3, b.min) && std::equal(a.max, a.max + 3, b.max);
}

/// A slot that refers to binary node `child` of the topology, or to nothing.
bool slot_is(const BinaryNode& node, int slot, std::uint32_t child, const BuiltTrees& built, bool triangles) {
    if (child == BOXWOOD_NONE) return node.child[slot] == BOXWOOD_NONE && equal(node.bounds[slot], empty);
    const std::uint32_t count = built.topology.size();
    std::uint32_t reference = child;
    if (child >= count) reference = BOXWOOD_LEAF | (triangles ? child - count : built.topology.order[child - count]);
    return node.child[slot] == reference && equal(node.bounds[slot], built.volumes[child]);
}

std::size_t wrong_nodes(const BinaryLayout& layout, const BuiltTrees& built, bool triangles) {
    const std::vector<BinaryNode> nodes = download(test_device(), layout.nodes);
    const std::vector<cl_uint2> children = layout_children(built.topology);
    REQUIRE(nodes.size() == children.size());
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        for (int slot = 0; slot < 2; ++slot)
            if (!slot_is(nodes[i], slot, children[i].s[slot], built, triangles)) ++wrong;
        if (nodes[i].reserved[0] != 0 || nodes[i].reserved[1] != 0) ++wrong;
    }
    return wrong;
}

/// Most inner nodes above a primitive; the root over one primitive is one.
std::uint32_t depth_of(const HostTopology& t) {
    std::uint32_t deepest = 1;
    for (std::uint32_t i = 0; i < t.size(); ++i) {
        std::uint32_t depth = 0;
        for (std::uint32_t node = t.parents[t.size() + i]; node != BOXWOOD_NONE; node = t.parents[node]) ++depth;
        deepest = std::max(deepest, depth);
    }
    return deepest;
}

std::size_t wrong_triangles(const BinaryLayout& layout, const BuiltTrees& built, const Scene& scene) {
    const std::vector<Triangle> triangles = download(test_device(), layout.leaves);
    const HostTopology& t = built.topology;
    REQUIRE(triangles.size() == t.size());
    std::size_t wrong = 0;
    for (std::uint32_t tree = 0; tree < t.trees(); ++tree) {
        const Mesh& mesh = scene.meshes[tree];
        for (std::uint32_t i = t.offsets[tree]; i < t.offsets[tree + 1]; ++i) {
            const std::uint32_t primitive = t.order[i] - t.offsets[tree];
            const glm::uvec3 corners = mesh.triangles[primitive];
            const glm::vec3 a = mesh.positions[corners.x], b = mesh.positions[corners.y], c = mesh.positions[corners.z];
            const Triangle expected{{a.x, a.y, a.z}, primitive, {b.x, b.y, b.z}, 0, {c.x, c.y, c.z}, 0};
            if (!same_bits<Triangle>({triangles[i]}, {expected})) ++wrong;
        }
    }
    return wrong;
}

void check(const Scene& scene) {
    Device& device = test_device();
    const BuiltTrees built = build_trees_of(device, scene);
    const BinaryTrees& trees = built.trees;
    const BinaryLayout layout = collapse_binary(device, trees.topology, trees.volumes.view(), &built.geometry);
    CHECK(wrong_nodes(layout, built, true) == 0);
    CHECK(wrong_triangles(layout, built, scene) == 0);
    CHECK(layout.depth == depth_of(built.topology));

    // The boxes of triangles stand in for those of instances.
    const BinaryLayout top = collapse_binary(device, trees.topology, trees.volumes.view());
    CHECK(wrong_nodes(top, built, false) == 0);
    CHECK(top.leaves.size() == 0);
    CHECK(top.depth == layout.depth);
}

} // namespace

TEST_CASE("collapse_binary: both children in each node, triangles in sorted order, the exact depth") {
    for (const std::size_t count : {1u, 2u, 3u, 4u, 257u, small_sizes() ? 300u : 3001u}) {
        CAPTURE(count);
        check(scene_of({random_mesh(count, 1.0f, 0.1f, count)}));
    }
    std::vector<Mesh> meshes;
    for (const std::size_t size : {1u, 2u, 1u, small_sizes() ? 270u : 700u, 3u, 1u, 40u})
        meshes.push_back(random_mesh(size, 1, 0.1f, size));
    check(scene_of(meshes));
    check(scene_of({random_mesh(1, 1, 1, 1), random_mesh(1, 1, 1, 2)}));
    check(scene_of({random_mesh(small_sizes() ? 270 : 1000, 0.0f, 0.0f, 3)})); // one point
}

TEST_CASE("collapse_binary: the same bytes at every tuning") {
    Device& device = test_device();
    const BuiltTrees built =
        build_trees_of(device, scene_of({random_mesh(1, 1, 1, 1), random_mesh(small_sizes() ? 270 : 900, 1, 0.1f, 4)}));
    const BinaryTrees& trees = built.trees;
    const auto run = [&] { return collapse_binary(device, trees.topology, trees.volumes.view(), &built.geometry); };
    const BinaryLayout expected = run();
    for (const Tuning& tuning : tunings()) {
        CAPTURE(tuning.group_size);
        const TuningScope scope(tuning);
        const BinaryLayout layout = run();
        CHECK(same_bits(download(device, layout.nodes), download(device, expected.nodes)));
        CHECK(same_bits(download(device, layout.leaves), download(device, expected.leaves)));
        CHECK(layout.depth == expected.depth);
    }
}
