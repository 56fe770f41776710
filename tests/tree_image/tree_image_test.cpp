// SPDX-License-Identifier: MIT
#include "boxwood/tree_image.hpp"

#include <limits>

#include <doctest/doctest.h>

#include "boxwood/error.hpp"
#include "io/samples.hpp"

TEST_SUITE_BEGIN("tree_image");

using namespace boxwood;
using boxwood::test::add_sample_area;
using boxwood::test::sample_scene;
using boxwood::test::sample_tree;

namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

/// Where validate refuses the sample tree after `change`; "accepted" when it does not.
template <class Change>
std::string refused_at(Layout layout, Levels levels, Change&& change, Bounds bounds = Bounds::aabb) {
    Scene scene = sample_scene();
    TreeImage tree = sample_tree(scene, layout, levels, bounds);
    if constexpr (std::is_invocable_v<Change, TreeImage&, Scene&>) {
        change(tree, scene);
    } else {
        change(tree);
    }
    try {
        validate(tree, scene, "file");
    } catch (const InputError& error) {
        CHECK(error.file == "file");
        return error.where;
    }
    return "accepted";
}

template <class Change>
std::string binary(Change&& change) {
    return refused_at(Layout::binary, Levels::two, std::forward<Change>(change));
}
template <class Change>
std::string wide(Change&& change) {
    return refused_at(Layout::wide8, Levels::two, std::forward<Change>(change));
}

template <class Change>
std::string oriented(Change&& change) {
    return refused_at(Layout::binary, Levels::two, std::forward<Change>(change), Bounds::obb_refined);
}

/// A binary tree of `count` nodes that goes down on one side, and its scene: the deepest that many nodes can make.
std::pair<Scene, TreeImage> chain(std::uint32_t count) {
    Scene scene;
    scene.meshes.push_back({"", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, std::vector<glm::uvec3>(count + 1, {0, 1, 2})});
    scene.instances.emplace_back();
    TreeImage tree;
    tree.layout = Layout::binary;
    for (std::uint32_t i = 0; i <= count; ++i) tree.triangles.push_back({{0, 0, 0}, i, {1, 0, 0}, 0, {0, 1, 0}, 0});
    const Aabb box{{0, 0, 0}, {1, 1, 0}};
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t next = i + 1 < count ? i + 1 : BOXWOOD_LEAF | count;
        tree.binary_nodes.push_back({{box, box}, {BOXWOOD_LEAF | i, next}, {0, 0}});
    }
    tree.bottom_depth = count;
    tree.sphere = scene_sphere(scene);
    return {scene, tree};
}

} // namespace

TEST_CASE("tree_image: names of layouts and levels go both ways") {
    for (const Layout layout : {Layout::binary, Layout::wide8}) CHECK(to_layout(name(layout)) == layout);
    for (const Levels levels : {Levels::automatic, Levels::one, Levels::two}) CHECK(to_levels(name(levels)) == levels);
    CHECK(name(Layout::wide8) == "wide8");
    CHECK(name(Levels::automatic) == "auto");
    CHECK_THROWS_WITH_AS(to_layout("wide4"), "layout: wide4: unknown word; use one of auto, binary, wide8", InputError);
    CHECK_THROWS_WITH_AS(to_levels(""), "levels: unknown word; use one of auto, one, two", InputError);
}

TEST_CASE("tree_image: the sample trees are valid and have the depths that their sizes give") {
    for (const Layout layout : {Layout::binary, Layout::wide8}) {
        for (const Levels levels : {Levels::one, Levels::two})
            CHECK(refused_at(layout, levels, [](auto&) {}) == "accepted");
    }
    for (const Levels levels : {Levels::one, Levels::two})
        CHECK(refused_at(
                  Layout::binary, levels, [](auto&) {}, Bounds::obb_points) == "accepted");
    const Scene scene = sample_scene();
    // Halving 37 leaves needs 6 levels, 39 too; 10 blocks need 2 of width 8; 3 instances need 2 of width 2.
    CHECK(sample_tree(scene, Layout::binary, Levels::two).bottom_depth == 6);
    CHECK(sample_tree(scene, Layout::binary, Levels::one).bottom_depth == 6);
    CHECK(sample_tree(scene, Layout::wide8, Levels::two).bottom_depth == 2);
    CHECK(sample_tree(scene, Layout::binary, Levels::two).top_depth == 2);
}

TEST_CASE("tree_image: influence areas with their trees and an index are valid, and what is wrong with one is named") {
    for (const Layout layout : {Layout::binary, Layout::wide8}) {
        const auto area = [&](auto&& change) {
            return refused_at(layout, Levels::one, [&](TreeImage& t) {
                add_sample_area(t);
                change(t);
            });
        };
        const std::string nodes = layout == Layout::binary ? "binary_nodes" : "wide_nodes";
        CHECK(area([](TreeImage&) {}) == "accepted");
        CHECK(area([](TreeImage& t) { t.bottom_depth = 1; }) == "bottom_depth");
        CHECK(area([](TreeImage& t) { t.areas[0].root = 0; }) == "areas[0].root");
        CHECK(area([](TreeImage& t) { t.areas[0].root = 1000; }) == "areas[0].root");
        CHECK(area([](TreeImage& t) { t.areas.push_back(t.areas[0]); }) == "areas[1].root");
        CHECK(area([](TreeImage& t) { t.areas[0].region.origin[1] = not_a_number; }) == "areas[0]");
        CHECK(area([](TreeImage& t) { t.areas[0].region.up[2] = 0.25f; }) == "areas[0]");
        CHECK(area([](TreeImage& t) { t.areas[0].region.far = 0.0f; }) == "areas[0]");
        CHECK(area([](TreeImage& t) { t.areas[0].region.half_width = infinity; }) == "areas[0]");
        CHECK(area([](TreeImage& t) { t.areas[0].region.sin_tolerance = 2.0f; }) == "areas[0]");
        CHECK(area([](TreeImage& t) { t.areas[0].region.share = -1.0f; }) == "areas[0]");
        CHECK(area([](TreeImage& t) { t.areas[0].box.min[0] = 3.0f; }) == "areas[0]");
        CHECK(area([](TreeImage& t) { t.areas[0].region.reserved = 1; }) == "areas[0]");
        CHECK(area([](TreeImage& t) { t.areas[0].near = 1.0f; }) == "areas[0]"); // of a plane area
        const auto near = [&](float value) {
            return area([=](TreeImage& t) {
                t.areas[0].region.point = 1;
                t.areas[0].near = value;
            });
        };
        CHECK(near(1.0f) == "accepted");
        CHECK(near(-1.0f) == "areas[0]");
        CHECK(near(2.0f) == "areas[0]"); // as far as it reaches
        CHECK(near(not_a_number) == "areas[0]");
        CHECK(area([](TreeImage& t) { t.area_index.nodes.clear(); }) == "area_nodes");
        CHECK(area([](TreeImage& t) { t.areas.clear(); }) == "area_nodes");
        CHECK(area([](TreeImage& t) { t.area_index.nodes[0].first = 0; }) == "area_nodes[0]"); // itself
        CHECK(area([](TreeImage& t) { t.area_index.nodes[0].first = 2; }) == "area_nodes[0]");
        CHECK(area([](TreeImage& t) { t.area_index.nodes[0].axis = 3; }) == "area_nodes[0]"); // eight children
        CHECK(area([](TreeImage& t) { t.area_index.nodes[0].axis = 4; }) == "area_nodes[0]");
        CHECK(area([](TreeImage& t) { t.area_index.nodes[1].first = 2; }) == "area_nodes[1]");
        CHECK(area([](TreeImage& t) { t.area_index.nodes[1].count = 2; }) == "area_items");
        CHECK(area([](TreeImage& t) { t.area_index.nodes[2].split[0] = 1.0f; }) == "area_nodes[2]");
        CHECK(area([](TreeImage& t) { t.area_index.items[1] = 1; }) == "area_nodes[2]");
        CHECK(area([](TreeImage& t) { t.area_index.kind = AreaIndexKind::automatic; }) == "area_index");
        const auto leaf = [&](TreeImage& t, std::uint32_t primitive) {
            (layout == Layout::binary ? t.triangles.back().primitive : t.blocks.back().primitive[0]) = primitive;
        };
        CHECK(area([&](TreeImage& t) { leaf(t, 1000); }) != "accepted");
        const auto two = [](TreeImage& t) { add_sample_area(t); };
        CHECK(refused_at(layout, Levels::two, two) == "areas");
    }
}

TEST_CASE("tree_image: an empty tree is valid for an empty scene only") {
    for (const Layout layout : {Layout::binary, Layout::wide8}) {
        TreeImage local = sample_tree(sample_scene(), layout, Levels::one);
        add_sample_area(local); // whose tree is not there
        TreeImage none = sample_tree({}, layout, Levels::one);
        none.areas = local.areas;
        none.area_index = local.area_index;
        for (const std::uint32_t root : {0u, 1u}) {
            none.areas[0].root = root;
            CHECK_THROWS_AS(validate(none, Scene{}, "file"), InputError);
        }
        for (const Levels levels : {Levels::one, Levels::two}) {
            const TreeImage tree = sample_tree({}, layout, levels);
            CHECK_NOTHROW(validate(tree, Scene{}, "file"));
            CHECK_THROWS_AS(validate(tree, sample_scene(), "file"), InputError);
        }
    }
}

TEST_CASE("tree_image: arrays of the other layout or of the other number of levels are refused") {
    CHECK(binary([](TreeImage& t) { t.wide_nodes.resize(1); }) != "accepted");
    CHECK(binary([](TreeImage& t) { t.blocks.resize(1); }) != "accepted");
    CHECK(binary([](TreeImage& t) { t.wide_top.resize(1); }) != "accepted");
    CHECK(wide([](TreeImage& t) { t.binary_nodes.resize(1); }) != "accepted");
    CHECK(wide([](TreeImage& t) { t.triangles.resize(1); }) != "accepted");
    CHECK(wide([](TreeImage& t) { t.binary_top.resize(1); }) != "accepted");
    CHECK(binary([](TreeImage& t) { t.oriented_nodes.resize(1); }) != "accepted");
    CHECK(wide([](TreeImage& t) { t.oriented_top.resize(1); }) != "accepted");
    CHECK(oriented([](TreeImage& t) { t.binary_nodes.resize(1); }) != "accepted");
    CHECK(oriented([](TreeImage& t) { t.wide_top.resize(1); }) != "accepted");
    CHECK(oriented([](TreeImage& t) { t.bounds = Bounds::aabb; }) != "accepted");
    CHECK(oriented([](TreeImage& t) { t.layout = Layout::wide8; }) == "bounds");
    CHECK(wide([](TreeImage& t) { t.bounds = Bounds::obb_boxes; }) == "bounds");
    CHECK(wide([](TreeImage& t) { t.layout = Layout::automatic; }) == "layout");
    CHECK(wide([](TreeImage& t) { t.levels = Levels::automatic; }) == "levels");
    CHECK(wide([](TreeImage& t) { t.levels = Levels::one; }) == "wide_top");
    CHECK(wide([](TreeImage& t) { t.layout = Layout::binary; }) != "accepted");
    const auto one = [](auto&& change) { return refused_at(Layout::wide8, Levels::one, change); };
    CHECK(one([](TreeImage& t) { t.levels = Levels::two; }) == "instances");
    CHECK(one([](TreeImage& t) { t.instances.resize(1); }) == "wide_top");
    CHECK(one([](TreeImage& t) { t.top_depth = 1; }) == "top_depth");
    CHECK(one([](TreeImage& t) { t.wide_nodes.clear(); }) == "wide_nodes");
    CHECK(one([](TreeImage& t) { t.blocks.clear(); }) == "blocks");
}

TEST_CASE("tree_image: a reference that leaves its array, repeats or turns back is refused") {
    // Node 0 is the tree of the one-triangle mesh, node 1 the root of the other.
    const auto end = [](const auto& array) { return static_cast<std::uint32_t>(array.size()); };
    CHECK(binary([&](TreeImage& t) { t.binary_nodes[1].child[0] = end(t.binary_nodes); }) ==
          "binary_nodes[1].child[0]");
    CHECK(binary([&](TreeImage& t) { t.binary_nodes[0].child[0] = BOXWOOD_LEAF | end(t.triangles); }) ==
          "binary_nodes[0].child[0]");
    CHECK(binary([](TreeImage& t) { t.binary_nodes[1].child[0] = 1; }) == "binary_nodes[1].child[0]"); // itself
    CHECK(binary([](TreeImage& t) { t.binary_nodes[1].child[0] = 0; }) == "binary_nodes[1].child[0]"); // another tree
    CHECK(binary([](TreeImage& t) { t.binary_nodes[1].child[0] = t.binary_nodes[1].child[1]; }) ==
          "binary_nodes[1].child[1]");
    CHECK(binary([](TreeImage& t) { t.binary_nodes[2].child[0] = 1; }) == "binary_nodes[2].child[0]"); // the parent
    CHECK(binary([](TreeImage& t) { t.binary_nodes[1].child[0] = BOXWOOD_LEAF | 0; }) != "accepted");
    CHECK(binary([](TreeImage& t) { t.binary_nodes[1].child[0] = BOXWOOD_NONE; }) == "binary_nodes[1].child[0]");
    CHECK(binary([](TreeImage& t) { t.binary_nodes[1].child[1] = BOXWOOD_NONE; }) == "binary_nodes[1]");
    CHECK(wide([&](TreeImage& t) { t.wide_nodes[1].child[7] = end(t.wide_nodes); }) == "wide_nodes[1].child[7]");
    CHECK(wide([](TreeImage& t) { t.wide_nodes[1].child[7] = 1; }) == "wide_nodes[1].child[7]");
    CHECK(wide([](TreeImage& t) { t.wide_nodes[1].child[7] = BOXWOOD_NONE; }) == "wide_nodes[1].child[7]");
    CHECK(binary([](TreeImage& t) { t.binary_top[0].child[0] = BOXWOOD_LEAF | 3; }) == "binary_top[0].child[0]");
    CHECK(binary([](TreeImage& t) { t.binary_top[0].child[1] = 0; }) == "binary_top[0].child[1]");
    CHECK(wide([](TreeImage& t) { t.wide_top[0].child[1] = t.wide_top[0].child[0]; }) == "wide_top[0].child[1]");
}

TEST_CASE("tree_image: a wide child before its parent is refused") { // refit goes through the array backwards
    CHECK(wide([](TreeImage& t) {
              // Swaps the root of the second mesh, node 1, with its first child node.
              std::uint32_t* slot = t.wide_nodes[1].child;
              while (*slot & BOXWOOD_LEAF) ++slot;
              const std::uint32_t child = *slot;
              *slot = 1;
              std::swap(t.wide_nodes[1], t.wide_nodes[child]);
              t.instances[1].root = child;
          }).starts_with("wide_nodes["));
}

TEST_CASE("tree_image: the stated depth must be exact") {
    CHECK(binary([](TreeImage& t) { ++t.bottom_depth; }) == "bottom_depth");
    CHECK(binary([](TreeImage& t) { --t.bottom_depth; }) == "bottom_depth");
    CHECK(wide([](TreeImage& t) { ++t.top_depth; }) == "top_depth");
    CHECK(wide([](TreeImage& t) { t.top_depth = 0; }) == "top_depth");
}

TEST_CASE("tree_image: a mesh without an instance may be the deepest, within the number of nodes") {
    const auto unplace = [](TreeImage& tree, Scene& scene) { // keeps the two instances of the one-triangle mesh
        scene.instances.erase(scene.instances.begin() + 1);
        const TreeImage smaller = sample_tree(scene, tree.layout, tree.levels);
        tree = smaller;
    };
    CHECK(binary([&](TreeImage& t, Scene& s) { unplace(t, s); }) == "accepted");
    CHECK(binary([&](TreeImage& t, Scene& s) {
              unplace(t, s);
              t.bottom_depth = 0;
          }) == "bottom_depth");
    CHECK(binary([&](TreeImage& t, Scene& s) {
              unplace(t, s);
              t.bottom_depth = static_cast<std::uint32_t>(t.binary_nodes.size()) + 1;
          }) == "bottom_depth");
}

TEST_CASE("tree_image: boxes that no ray test can use are refused") {
    CHECK(binary([](TreeImage& t) { t.binary_nodes[1].bounds[1].max[2] = not_a_number; }) ==
          "binary_nodes[1].child[1]");
    CHECK(binary([](TreeImage& t) { t.binary_nodes[1].bounds[0].min[0] = infinity; }) == "binary_nodes[1].child[0]");
    CHECK(wide([](TreeImage& t) { t.wide_nodes[1].min_y[3] = not_a_number; }) == "wide_nodes[1].child[3]");
    CHECK(wide([](TreeImage& t) { t.wide_top[0].max_z[0] = -infinity; }) == "wide_top[0].child[0]");
}

TEST_CASE("tree_image: oriented boxes that no ray test can use are refused") {
    // Node 0 is the tree over one triangle. In the sample, slots with even references are aligned, the others are not.
    const auto slot_of = [](const TreeImage& t, bool aligned) {
        for (std::uint32_t node = 1; node < t.oriented_nodes.size(); ++node)
            for (std::uint32_t slot = 0; slot < 2; ++slot)
                if (((t.oriented_nodes[node].child[slot] & BOXWOOD_ALIGNED) != 0) == aligned)
                    return std::pair(node, slot);
        FAIL("the sample lacks such a slot");
        return std::pair(0u, 0u);
    };
    std::string where;
    const auto with = [&](bool aligned, auto&& change) {
        return oriented([&](TreeImage& t) {
            const auto [node, slot] = slot_of(t, aligned);
            where = "oriented_nodes[" + std::to_string(node) + "].child[" + std::to_string(slot) + "]";
            change(t.oriented_nodes[node].volume[slot], t.oriented_nodes[node].child[slot]);
        });
    };
    using Reference = std::uint32_t;
    CHECK(with(true, [](float* v, Reference&) { std::swap(v[0], v[3]); }) == where);
    CHECK(with(true, [](float* v, Reference&) { v[4] = not_a_number; }) == where);
    CHECK(with(true, [](float* v, Reference&) { v[14] = 1.0f; }) == where);
    CHECK(with(true, [](float*, Reference& r) { r &= ~BOXWOOD_ALIGNED; }) == where); // no axes
    CHECK(with(true, [](float*, Reference& r) { r |= 0x3fffffffu; }) != "accepted");
    CHECK(with(false, [](float* v, Reference&) { v[0] = infinity; }) == where);
    CHECK(with(false, [](float* v, Reference&) { v[3] = -1.0f; }) == where);
    CHECK(with(false, [](float* v, Reference&) { v[5] = not_a_number; }) == where);
    CHECK(with(false, [](float* v, Reference&) { v[14] = -infinity; }) == where);
    CHECK(with(false, [](float* v, Reference&) { v[7] = v[10] = v[13] = 0.0f; }) == where);
    CHECK(with(false, [](float*, Reference& r) { r |= BOXWOOD_ALIGNED; }) == where); // axes behind the box
    CHECK(oriented([](TreeImage& t) { t.oriented_nodes[0].volume[1][0] = 0; }) == "oriented_nodes[0].child[1]");
    CHECK(oriented([](TreeImage& t) { t.oriented_nodes[0].volume[1][9] = 1; }) == "oriented_nodes[0].child[1]");
    CHECK(oriented([](TreeImage& t) { // the same child again, aligned or not
              std::uint32_t* child = t.oriented_nodes[1].child;
              child[0] = (child[1] & ~BOXWOOD_ALIGNED) | (child[0] & BOXWOOD_ALIGNED);
          }) == "oriented_nodes[1].child[1]");
    CHECK(oriented([](TreeImage& t) { t.oriented_nodes[1].child[1] = BOXWOOD_NONE; }) == "oriented_nodes[1]");
    CHECK(oriented([](TreeImage& t) { ++t.bottom_depth; }) == "bottom_depth");
    CHECK(oriented([](TreeImage& t) { t.oriented_top.clear(); }) == "oriented_top");
}

TEST_CASE("tree_image: a slot that is not in use must be empty") {
    CHECK(binary([](TreeImage& t) { t.binary_nodes[0].bounds[1].min[0] = 0; }) == "binary_nodes[0].child[1]");
    CHECK(wide([](TreeImage& t) { t.wide_nodes[0].child[5] = 1; }) == "wide_nodes[0].child[5]");
    CHECK(wide([](TreeImage& t) { t.wide_nodes[0].max_x[5] = not_a_number; }) == "wide_nodes[0].child[5]");
    CHECK(wide([](TreeImage& t) { t.wide_nodes[0].count = 0; }) == "wide_nodes[0]");
    CHECK(wide([](TreeImage& t) { t.wide_nodes[0].count = 9; }) == "wide_nodes[0]");
    CHECK(wide([](TreeImage& t) { t.wide_nodes[0].count = 2; }) == "wide_nodes[0].child[1]");
    CHECK(wide([](TreeImage& t) { t.wide_nodes[1].count = 7; }) == "wide_nodes[1].child[7]");
    CHECK(wide([](TreeImage& t) { t.wide_nodes[1].reserved[6] = 1; }) == "wide_nodes[1]");
    CHECK(binary([](TreeImage& t) { t.binary_nodes[1].reserved[1] = 1; }) == "binary_nodes[1]");
}

TEST_CASE("tree_image: a leaf must name each primitive of its mesh once") {
    CHECK(binary([](TreeImage& t) { t.triangles[0].primitive = 1; }) == "triangles[0]"); // of a mesh of one
    CHECK(binary([](TreeImage& t) { t.triangles[1].primitive = 37; }) == "triangles[1]");
    CHECK(binary([](TreeImage& t) { t.triangles[1].primitive = 36; }).starts_with("triangles["));
    CHECK(binary([](TreeImage& t) { t.triangles[1].reserved1 = 1; }) == "triangles[1]");
    CHECK(binary([](TreeImage& t) { t.triangles[1].v2[2] = infinity; }) == "triangles[1]");
    CHECK(wide([](TreeImage& t) { t.blocks[0].primitive[0] = BOXWOOD_NONE; }) == "blocks[0]");
    CHECK(wide([](TreeImage& t) { t.blocks[0].primitive[2] = 0; }) == "blocks[0]"); // behind an unused slot
    CHECK(wide([](TreeImage& t) { t.blocks[0].v1_y[3] = 1; }) == "blocks[0]");
    CHECK(wide([](TreeImage& t) { t.blocks[1].v0_z[3] = not_a_number; }) == "blocks[1]");
    CHECK(wide([](TreeImage& t) { std::swap(t.blocks[1].primitive[0], t.blocks[1].primitive[1]); }) == "blocks[1]");
    CHECK(wide([](TreeImage& t) { t.blocks.back().primitive[0] = 37; }) == "blocks[10]");
    // One level: 39 triangles as flattened.
    const auto one = [](auto&& change) { return refused_at(Layout::binary, Levels::one, change); };
    CHECK(one([](TreeImage& t) { t.triangles[0].primitive = 39; }) == "triangles[0]");
    CHECK(one([](TreeImage& t) { t.triangles[0].primitive = 38; }).starts_with("triangles["));
}

TEST_CASE("tree_image: a tree that leaves out primitives or instances is refused") {
    CHECK(wide([](TreeImage& t) { // drops the last slot of the second mesh's root
              Wide8Node& root = t.wide_nodes[1];
              root.count = 7;
              root.child[7] = BOXWOOD_NONE;
              root.min_x[7] = root.min_y[7] = root.min_z[7] = infinity;
              root.max_x[7] = root.max_y[7] = root.max_z[7] = -infinity;
          }) == "wide_nodes[1]");
    CHECK(wide([](TreeImage& t) { t.wide_top.clear(); }) == "wide_top");
    CHECK(binary([](TreeImage& t) { t.binary_top[0] = t.binary_top[1]; }) == "binary_top");
}

TEST_CASE("tree_image: one level over several instances must say where each one's triangles start") {
    const auto one = [](auto&& change) { return refused_at(Layout::wide8, Levels::one, change); };
    CHECK(one([](TreeImage& t) { t.first_triangles.clear(); }) == "first_triangles");
    CHECK(one([](TreeImage& t) { t.first_triangles.push_back(39); }) == "first_triangles");
    CHECK(one([](TreeImage& t) { t.first_triangles[0] = 1; }) == "first_triangles[0]");
    CHECK(one([](TreeImage& t) { t.first_triangles[2] = 37; }) == "first_triangles[2]");
    CHECK(one([](TreeImage& t) { t.first_triangles[3] = 40; }) == "first_triangles[3]");
    CHECK(wide([](TreeImage& t) { t.first_triangles = {0, 1, 38, 39}; }) == "first_triangles"); // two levels
    auto [scene, tree] = chain(3);                                                              // one instance
    tree.first_triangles = {0, 4};
    CHECK_THROWS_AS(validate(tree, scene, "file"), InputError);
}

TEST_CASE("tree_image: an instance record must agree with the scene") {
    CHECK(wide([](TreeImage& t) { t.instances.pop_back(); }) == "instances");
    CHECK(wide([](TreeImage& t) { t.instances[1].mesh = 0; }) == "instances[1]");
    CHECK(wide([](TreeImage& t) { t.instances[1].mesh = 2; }) == "instances[1]");
    CHECK(wide([](TreeImage& t) { t.instances[1].reserved[1] = 1; }) == "instances[1]");
    CHECK(wide([](TreeImage& t) { t.instances[1].to_object[11] = not_a_number; }) == "instances[1]");
    CHECK(wide([](TreeImage& t) { t.instances[1].to_world[3] = 5; }) == "instances[1]");
    CHECK(wide([](TreeImage& t) { t.instances[1].root = 1000; }) == "instances[1].root");
    CHECK(wide([](TreeImage& t) { t.instances[1].root = 0; }) == "instances[1].root"); // the other mesh's
    CHECK(wide([](TreeImage& t) { t.instances[2].root = 1; }) == "instances[2].root"); // first instance says 0
    CHECK(wide([](TreeImage& t) { t.instances[1].root = BOXWOOD_NONE; }) == "instances[1].root");
}

TEST_CASE("tree_image: a tree as deep as it has nodes is walked without recursion") {
    // 200,000 nested calls would pass the usual 8 MiB of stack.
    auto [scene, tree] = chain(200000);
    CHECK_NOTHROW(validate(tree, scene, "file"));
    tree.bottom_depth = 199999;
    CHECK_THROWS_AS(validate(tree, scene, "file"), InputError);
}

TEST_CASE(
    "tree_image: a small tree for a scene of very many instanced triangles is refused without taking memory for them") {
    auto [scene, tree] = chain(1000);
    scene.instances.resize(std::size_t{1} << 16, scene.instances[0]);
    CHECK_THROWS_AS(validate(tree, scene, "file"), InputError);
}

TEST_SUITE_END();
