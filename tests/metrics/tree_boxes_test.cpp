// SPDX-License-Identifier: MIT
#include "metrics/tree_boxes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "boxwood/build.hpp"
#include "boxwood/influence.hpp"
#include "build/built_trees.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("metrics");

namespace {

constexpr DepthRange all_depths{0, 1000};

using Bounds6 = std::array<float, 6>;

/// Minimum and maximum of each box, sorted.
std::vector<Bounds6> bounds_of(const Mesh& lines) {
    std::vector<Bounds6> result;
    for (std::size_t i = 0; i < lines.positions.size(); i += 8) {
        glm::vec3 low = lines.positions[i], high = low;
        for (std::size_t corner = i; corner < i + 8; ++corner) {
            low = glm::min(low, lines.positions[corner]);
            high = glm::max(high, lines.positions[corner]);
        }
        result.push_back({low.x, low.y, low.z, high.x, high.y, high.z});
    }
    std::sort(result.begin(), result.end());
    return result;
}

/// Whether boxes are the same but for the padding of the triangles' boxes, which the test has more of.
bool fit(const std::vector<Bounds6>& boxes, const std::vector<Bounds6>& expected) {
    if (boxes.size() != expected.size()) return false;
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for (std::size_t k = 0; k < 6; ++k)
            if (!(std::fabs(boxes[i][k] - expected[i][k]) <= 2e-6f)) return false;
    return true;
}

Scene lines_of(const Scene& scene, const BuildOptions& options, DepthRange depths) {
    return box_lines(download(test_device(), build(test_device(), scene, options)), scene, depths);
}

} // namespace

TEST_CASE("tree_boxes: a binary tree gives the boxes of all its nodes, by depth") {
    const BuiltTrees built = build_trees_of(test_device(), scene_of({random_mesh(100, 1.0f, 0.2f, 21)}));
    const Scene scene = scene_of({random_mesh(100, 1.0f, 0.2f, 21)});
    BuildOptions options;
    options.layout = Layout::binary;
    // By depth, from the topology.
    std::vector<std::vector<Bounds6>> expected(1000);
    const auto add = [&](const auto& self, std::uint32_t node, std::size_t depth) -> void {
        const Aabb& box = built.volumes[node];
        expected[depth].push_back({box.min[0], box.min[1], box.min[2], box.max[0], box.max[1], box.max[2]});
        if (node >= built.topology.size()) return;
        self(self, built.topology.children[node].s[0], depth + 1);
        self(self, built.topology.children[node].s[1], depth + 1);
    };
    add(add, built.topology.root(0), 0);
    std::vector<Bounds6> everything;
    for (std::uint32_t depth = 0; depth < 30; ++depth) {
        CAPTURE(depth);
        std::sort(expected[depth].begin(), expected[depth].end());
        everything.insert(everything.end(), expected[depth].begin(), expected[depth].end());
        const Scene lines = lines_of(scene, options, {depth, depth});
        CHECK(lines.meshes.size() == (expected[depth].empty() ? 0 : 1));
        if (!lines.meshes.empty()) CHECK(fit(bounds_of(lines.meshes[0]), expected[depth]));
    }
    CHECK(everything.size() == 199);
    std::sort(everything.begin(), everything.end());
    CHECK(fit(bounds_of(lines_of(scene, options, all_depths).meshes.at(0)), everything));
}

TEST_CASE("tree_boxes: each box has its twelve edges") {
    const Scene lines = lines_of(scene_of({random_mesh(1, 1.0f, 1.0f, 22)}), {}, {1, 1});
    const Mesh& mesh = lines.meshes.at(0);
    REQUIRE(mesh.positions.size() == 8);
    REQUIRE(mesh.triangles.size() == 8);
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (std::size_t i = 0; i < 24; i += 2) {
        const auto end = [&](std::size_t k) { return mesh.triangles[k / 3][static_cast<int>(k % 3)]; };
        const glm::vec3 along = mesh.positions[end(i + 1)] - mesh.positions[end(i)];
        CHECK((along.x != 0) + (along.y != 0) + (along.z != 0) == 1);
        edges.insert({end(i), end(i + 1)});
    }
    CHECK(edges.size() == 12);
}

TEST_CASE("tree_boxes: two levels place each mesh's boxes as its instances are, and name them") {
    Scene scene = scene_of({random_mesh(50, 1.0f, 0.2f, 23), random_mesh(9, 1.0f, 0.2f, 24), random_mesh(5, 1, 1, 25)});
    scene.meshes[0].name = "first";
    scene.instances.pop_back(); // the third mesh has no instance
    scene.instances.push_back(scene.instances[0]);
    scene.instances.back().transform[3] = glm::vec4(5, 6, 7, 1);
    for (const Layout layout : {Layout::binary, Layout::wide8}) {
        BuildOptions options;
        options.levels = Levels::two;
        options.layout = layout;
        const Scene lines = lines_of(scene, options, all_depths);
        CHECK_NOTHROW(validate(lines, "lines"));
        REQUIRE(lines.meshes.size() == 3);
        CHECK(lines.meshes[0].name == "boxes of the top level");
        CHECK(lines.meshes[1].name == "boxes of first");
        REQUIRE(lines.instances.size() == 4);
        CHECK(lines.instances[3].mesh == 1);
        CHECK(lines.instances[3].transform == scene.instances[2].transform);
        if (layout == Layout::binary) {
            CHECK(lines.meshes[0].positions.size() == 8 * 5);
            CHECK(lines.meshes[1].positions.size() == 8 * 99);
            CHECK(lines.meshes[2].positions.size() == 8 * 17);
        }
        // Below the shallower trees only the deepest are left, with their instances.
        const Scene none = lines_of(scene, options, {900, 1000});
        CHECK(none.meshes.empty());
        CHECK(none.instances.empty());
    }
    CHECK(box_lines(TreeImage{}, Scene{}, all_depths).meshes.empty());
}

TEST_CASE("tree_boxes: an oriented box has the corners of its parallelepiped") {
    // |x - 1| <= 2, |y + z| <= 3, |z| <= 4 as axes (1 0 0), (0 1 1), (0 0 1): corners x = 1 -+ 2, z = -+4, y = -+3 - z.
    OrientedNode node{};
    const float first[15] = {1, 0, 0, 2, 3, 4, 1, 0, 0, 0, 1, 0, 0, 1, 1};
    std::copy(std::begin(first), std::end(first), node.volume[0]);
    const float second[6] = {-9, -9, -9, 1, 1, 1}; // an AABB
    std::copy(std::begin(second), std::end(second), node.volume[1]);
    node.child[0] = BOXWOOD_LEAF | 0u;
    node.child[1] = BOXWOOD_LEAF | BOXWOOD_ALIGNED | 1u;
    TreeImage tree;
    tree.layout = Layout::binary;
    tree.bounds = Bounds::obb_points;
    tree.oriented_nodes = {node};
    const Scene scene = scene_of({random_mesh(2, 1.0f, 1.0f, 26)});
    const Mesh lines = box_lines(tree, scene, {1, 1}).meshes.at(0);
    REQUIRE(lines.positions.size() == 16);
    for (int i = 0; i < 8; ++i) {
        const float x = i & 1 ? 3.0f : -1.0f, y = i & 2 ? 3.0f : -3.0f, z = i & 4 ? 4.0f : -4.0f;
        CHECK(lines.positions[i] == glm::vec3(x, y - z, z));
    }
    CHECK(bounds_of(box_lines(tree, scene, {0, 0}).meshes.at(0)) == std::vector<Bounds6>{{-9, -9, -9, 3, 7, 4}});
}

TEST_CASE("tree_boxes: regions of influence areas as lines: twelve edges each") {
    InfluenceArea plane, point;
    plane.half_width = 2;
    plane.far = 3;
    point.kind = AreaKind::point;
    point.near = 1;
    point.far = 4;
    Scene lines;
    add_area_lines(influence_records(std::vector<InfluenceArea>{plane, point}), lines);
    REQUIRE(lines.meshes.size() == 2);
    CHECK(lines.instances.size() == 2);
    CHECK(lines.meshes[1].name == "area 1");
    CHECK(bounds_of(lines.meshes[0]) == std::vector<Bounds6>{{-2, -1, -3, 2, 1, 0}});
    CHECK(bounds_of(lines.meshes[1]) == std::vector<Bounds6>{{-4, -4, -4, 4, 4, -1}});
    // Each edge joins corners that share two of the six sides.
    for (const Mesh& mesh : lines.meshes) {
        std::vector<std::uint32_t> ends;
        for (const glm::uvec3& t : mesh.triangles) ends.insert(ends.end(), {t.x, t.y, t.z});
        REQUIRE(ends.size() == 24);
        for (std::size_t i = 0; i < 24; i += 2) {
            const glm::vec3 a = mesh.positions[ends[i]], b = mesh.positions[ends[i + 1]];
            CHECK(((a.x * b.x > 0) + (a.y * b.y > 0) + (a.z == b.z)) == 2);
        }
    }
}

TEST_SUITE_END();
