// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>

#include "boxwood/collapse.hpp"
#include "build/built_trees.hpp"
#include "oracles/wide_cost.hpp"
#include "support.hpp"
#include "tuning.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("layout");

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
// As host/layout/collapse_wide.cpp: a leaf of triangles costs what a node does, an instance what a small tree does.
constexpr CostModel triangle_model{1.0, 1.0, 4}, instance_model{1.0, 4.0, 1};

/// A collapsed forest in host arrays.
struct Wide {
    std::vector<Wide8Node> nodes;
    std::vector<Triangle4> blocks;
    std::uint32_t depth = 0;
};

Wide to_host(const WideLayout& layout) {
    return {download(test_device(), layout.nodes), download(test_device(), layout.leaves), layout.depth};
}

Wide collapse_triangles(const BuiltTrees& built) {
    return to_host(collapse_wide(test_device(), built.trees.topology, built.trees.volumes.view(), &built.geometry));
}

Wide collapse_instances(const BuiltTrees& built) {
    return to_host(collapse_wide(test_device(), built.trees.topology, built.trees.volumes.view()));
}

Aabb slot_box(const Wide8Node& node, std::uint32_t slot) {
    return {{node.min_x[slot], node.min_y[slot], node.min_z[slot]},
            {node.max_x[slot], node.max_y[slot], node.max_z[slot]}};
}

bool equal(const Aabb& a, const Aabb& b) {
    return std::equal(a.min, a.min + 3, b.min) && std::equal(a.max, a.max + 3, b.max);
}

/// Reads one layout against the binary forest that it was made from.
class Reader {
public:
    Reader(const BuiltTrees& built, const Wide& wide, bool triangles)
        : built_(built), wide_(wide), triangles_(triangles), position_(built.topology.size()),
          seen_(built.topology.size()) {
        const HostTopology& t = built.topology;
        for (std::uint32_t i = 0; i < t.size(); ++i) position_[t.order[i]] = i;
        for (std::uint32_t node = 0; node < 2 * t.size(); ++node) {
            const Span span = span_of(t, node);
            // An unused slot has the range of the leaf at its position.
            if (node >= t.size() || span.first != span.last) by_range_[{span.first, span.last}] = node;
        }
    }

    /// What is wrong, "" when all is well.
    std::string check() {
        check_numbering();
        std::uint32_t deepest = 0;
        for (std::uint32_t tree = 0; tree < built_.topology.trees(); ++tree) {
            const std::uint32_t root = built_.topology.root(tree);
            const Reached reached = walk(tree, tree);
            deepest = std::max(deepest, reached.depth);
            const Span span = span_of(built_.topology, root);
            if (reached.first != span.first || reached.last != span.last) fail("root does not cover its tree");
        }
        if (deepest != wide_.depth) fail("depth");
        if (std::find(seen_.begin(), seen_.end(), false) != seen_.end()) fail("a primitive is in no leaf");
        return wrong_;
    }

    /// Expected cost per ray that hits the tree's box.
    double cost(std::uint32_t tree, CostModel model) const {
        const double root = area_of(built_.volumes[built_.topology.root(tree)]);
        return model.node + cost_below(tree, model) / root;
    }

private:
    struct Reached {
        std::uint32_t first, last, depth;
    };

    void fail(const char* what) {
        if (wrong_.empty()) wrong_ = what;
    }

    /// Breadth first: scanned in order, nodes refer to inner children and to leaves in order.
    void check_numbering() {
        std::uint32_t next_node = built_.topology.trees(), next_block = 0;
        for (const Wide8Node& node : wide_.nodes) {
            if (node.count < 1 || node.count > 8) fail("count");
            for (const std::uint32_t word : node.reserved)
                if (word != 0) fail("reserved word");
            for (std::uint32_t slot = 0; slot < 8; ++slot) {
                const std::uint32_t child = node.child[slot];
                if (slot >= node.count) {
                    const Aabb empty{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
                    if (child != BOXWOOD_NONE || !equal(slot_box(node, slot), empty)) fail("unused slot");
                } else if (!(child & BOXWOOD_LEAF)) {
                    if (child != next_node++) fail("number of a node");
                } else if (triangles_ && (child & ~BOXWOOD_LEAF) != next_block++) {
                    fail("number of a block");
                }
            }
        }
        if (next_node != wide_.nodes.size()) fail("nodes that nothing refers to");
        if (triangles_ && next_block != wide_.blocks.size()) fail("blocks that nothing refers to");
    }

    Reached walk(std::uint32_t index, std::uint32_t tree) {
        const Wide8Node& node = wide_.nodes.at(index);
        Reached whole{BOXWOOD_NONE, 0, 0};
        for (std::uint32_t slot = 0; slot < std::min(node.count, 8u); ++slot) {
            const std::uint32_t child = node.child[slot];
            const Reached part = child & BOXWOOD_LEAF ? leaf(child & ~BOXWOOD_LEAF, tree) : walk(child, tree);
            const auto found = by_range_.find({part.first, part.last});
            if (found == by_range_.end())
                fail("a child is no node of the binary tree");
            else if (!equal(slot_box(node, slot), built_.volumes[found->second]))
                fail("box of a child");
            if (slot > 0 && part.first != whole.last + 1) fail("children do not follow one another");
            whole = {std::min(whole.first, part.first), part.last, std::max(whole.depth, part.depth)};
        }
        ++whole.depth;
        return whole;
    }

    void reach(std::uint32_t primitive) {
        if (primitive >= seen_.size()) return fail("primitive out of range");
        if (seen_[primitive]) fail("primitive in two leaves");
        seen_[primitive] = true;
    }

    Reached leaf(std::uint32_t index, std::uint32_t tree) {
        if (!triangles_) {
            reach(index);
            return {position_[index], position_[index], 0};
        }
        const Triangle4& block = wide_.blocks.at(index);
        const std::uint32_t base = built_.topology.offsets[tree];
        Reached range{BOXWOOD_NONE, 0, 0};
        bool ended = false;
        for (int lane = 0; lane < 4; ++lane) {
            const std::uint32_t primitive = block.primitive[lane];
            const bool used = primitive != BOXWOOD_NONE;
            if (lane == 0 && !used) fail("empty block");
            if (used && ended) fail("hole in a block");
            ended = ended || !used;
            check_lane(block, lane, used ? base + primitive : BOXWOOD_NONE);
            if (!used) continue;
            if (lane > 0 && primitive <= block.primitive[lane - 1]) fail("block not ascending");
            reach(base + primitive);
            range.first = std::min(range.first, position_.at(base + primitive));
            range.last = std::max(range.last, position_.at(base + primitive));
        }
        return range;
    }

    /// Corners of scene triangle `primitive`, zeros for none.
    void check_lane(const Triangle4& b, int lane, std::uint32_t primitive) {
        const float got[] = {b.v0_x[lane], b.v0_y[lane], b.v0_z[lane], b.v1_x[lane], b.v1_y[lane],
                             b.v1_z[lane], b.v2_x[lane], b.v2_y[lane], b.v2_z[lane]};
        float expected[9] = {};
        if (primitive != BOXWOOD_NONE) {
            const glm::vec3* corner = corners_.data() + 3 * std::size_t(primitive);
            for (int k = 0; k < 3; ++k) {
                expected[k] = corner[0][k];
                expected[3 + k] = corner[1][k];
                expected[6 + k] = corner[2][k];
            }
        }
        if (!std::equal(got, got + 9, expected)) fail("corners of a triangle");
    }

    double cost_below(std::uint32_t index, CostModel model) const {
        const Wide8Node& node = wide_.nodes[index];
        double sum = 0.0;
        for (std::uint32_t slot = 0; slot < node.count; ++slot) {
            const bool is_leaf = (node.child[slot] & BOXWOOD_LEAF) != 0;
            sum += area_of(slot_box(node, slot)) * (is_leaf ? model.leaf : model.node);
            if (!is_leaf) sum += cost_below(node.child[slot], model);
        }
        return sum;
    }

    std::vector<glm::vec3> download_corners() const {
        const std::vector<float> positions = download(test_device(), built_.geometry.positions);
        std::vector<glm::vec3> corners;
        for (const std::uint32_t vertex : download(test_device(), built_.geometry.triangles))
            corners.emplace_back(positions[3 * vertex], positions[3 * vertex + 1], positions[3 * vertex + 2]);
        return corners;
    }

    const BuiltTrees& built_;
    const Wide& wide_;
    const bool triangles_;
    std::vector<std::uint32_t> position_;
    std::vector<bool> seen_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> by_range_;
    std::vector<glm::vec3> corners_ = download_corners();
    std::string wrong_;
};

std::string wrong_with(const Scene& scene) {
    const BuiltTrees built = build_trees_of(test_device(), scene);
    return Reader(built, collapse_triangles(built), true).check();
}

/// Meshes of 1 to `most` triangles, dense and sparse, long and short.
Scene many_small_meshes(std::size_t most, std::uint64_t salt) {
    std::vector<Mesh> meshes;
    for (std::size_t size = 1; size <= most; ++size)
        for (const float triangle : {0.01f, 0.2f, 1.5f})
            meshes.push_back(random_mesh(size, 1.0f, triangle, salt + size));
    return scene_of(std::move(meshes));
}

} // namespace

TEST_CASE("collapse_wide: every triangle once, boxes of the binary tree, breadth-first numbers") {
    for (const std::size_t count : {1u, 2u, 3u, 4u, 5u, 8u, 9u, 33u, 257u, small_sizes() ? 300u : 5003u}) {
        CAPTURE(count);
        CHECK(wrong_with(scene_of({random_mesh(count, 1.0f, 0.1f, count)})) == "");
    }
    CHECK(wrong_with(many_small_meshes(40, 1)) == "");
}

TEST_CASE("collapse_wide: points, lines and identical triangles") {
    Mesh line = random_mesh(300, 1.0f, 0.0f, 2);
    for (glm::vec3& p : line.positions) p.y = p.z = 0.5f;
    Mesh plane = random_mesh(300, 1.0f, 0.1f, 3);
    for (glm::vec3& p : plane.positions) p.x = -1.0f;
    Mesh point = random_mesh(300, 0.0f, 0.0f, 4);
    Mesh same = random_mesh(1, 1.0f, 1.0f, 5);
    same.triangles.assign(300, same.triangles[0]);
    Mesh points = random_mesh(300, 1.0f, 0.0f, 6);
    for (const Mesh& mesh : {line, plane, point, same, points}) CHECK(wrong_with(scene_of({mesh})) == "");
    CHECK(wrong_with(scene_of({line, point, plane, same, random_mesh(10, 1.0f, 0.1f, 7), points})) == "");
}

TEST_CASE("collapse_wide: no cheaper tree of wide nodes exists") {
    const Scene scene = many_small_meshes(45, 8);
    const BuiltTrees built = build_trees_of(test_device(), scene);
    const Wide wide = collapse_triangles(built);
    const Reader reader(built, wide, true);
    for (std::uint32_t tree = 0; tree < built.topology.trees(); ++tree) {
        const std::size_t triangles = scene.meshes[tree].triangles.size();
        CAPTURE(triangles);
        // Costs are sums of under a hundred positive floats.
        const double least = least_cost(built.topology, built.volumes, tree, triangle_model);
        CHECK(reader.cost(tree, triangle_model) == doctest::Approx(least).epsilon(1e-5));
    }
}

TEST_CASE("collapse_wide: over instances, every one once and at least cost") {
    for (const std::size_t count : {1u, 2u, 3u, 7u, 8u, 9u, 15u, 21u, 300u}) {
        CAPTURE(count);
        // The boxes of triangles stand in for those of instances.
        const BuiltTrees built = build_trees_of(test_device(), scene_of({random_mesh(count, 1.0f, 0.3f, 20 + count)}));
        const Wide wide = collapse_instances(built);
        Reader reader(built, wide, false);
        CHECK(reader.check() == "");
        CHECK(wide.blocks.empty());
        if (count > 22) continue;
        const double least = least_cost(built.topology, built.volumes, 0, instance_model);
        CHECK(reader.cost(0, instance_model) == doctest::Approx(least).epsilon(1e-5));
    }
}

TEST_CASE("collapse_wide: the same structure at every power-of-two scale, the same bytes at every tuning") {
    const Scene scene = many_small_meshes(30, 9);
    const BuiltTrees built = build_trees_of(test_device(), scene);
    const Wide expected = collapse_triangles(built);
    for (const Tuning& tuning : tunings()) {
        CAPTURE(tuning.group_size);
        const TuningScope scope(tuning);
        const Wide wide = collapse_triangles(built);
        CHECK(same_bits(wide.nodes, expected.nodes));
        CHECK(same_bits(wide.blocks, expected.blocks));
    }
    // 2^58: areas are beyond float, coordinates are not. 2^-80: areas vanish in float.
    for (const int k : {-80, -40, 40, 58}) {
        CAPTURE(k);
        Scene scaled = scene;
        for (Mesh& mesh : scaled.meshes)
            for (glm::vec3& p : mesh.positions) p = {std::ldexp(p.x, k), std::ldexp(p.y, k), std::ldexp(p.z, k)};
        const Wide wide = collapse_triangles(build_trees_of(test_device(), scaled));
        REQUIRE(wide.nodes.size() == expected.nodes.size());
        REQUIRE(wide.blocks.size() == expected.blocks.size());
        for (std::size_t i = 0; i < wide.nodes.size(); ++i)
            CHECK(std::equal(wide.nodes[i].child, wide.nodes[i].child + 8, expected.nodes[i].child));
        for (std::size_t i = 0; i < wide.blocks.size(); ++i)
            CHECK(std::equal(wide.blocks[i].primitive, wide.blocks[i].primitive + 4, expected.blocks[i].primitive));
    }
}
