// SPDX-License-Identifier: MIT
#include "boxwood/tree_image.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "boxwood/error.hpp"
#include "common/words.hpp"
#include "tree_image/area_check.hpp"
#include "tree_image/tree_walker.hpp"

namespace boxwood {

namespace {

using namespace detail::tree_check;

constexpr Words<Layout, 3> layouts = {
    {{"auto", Layout::automatic}, {"binary", Layout::binary}, {"wide8", Layout::wide8}}};
constexpr Words<Levels, 3> level_choices = {{{"auto", Levels::automatic}, {"one", Levels::one}, {"two", Levels::two}}};

/// The primitives that one tree must hold, `count` from `first` in the marks, each in exactly one leaf.
struct PrimitiveSet {
    std::vector<bool>& seen;
    std::uint64_t first;
    std::uint64_t count;
    std::uint64_t reached = 0;
    std::vector<std::uint32_t>* named = nullptr; ///< Takes all that are reached, if there.

    /// Marks a primitive; returns what is wrong with it, or null.
    const char* reach(std::uint32_t primitive) {
        if (primitive >= count) return "names a primitive out of range";
        if (seen[first + primitive]) return "names a primitive that another leaf names";
        seen[first + primitive] = true;
        ++reached;
        if (named) named->push_back(primitive);
        return nullptr;
    }
};

const char* wrong_with(const Triangle& leaf, PrimitiveSet& primitives) {
    if (leaf.reserved1 != 0 || leaf.reserved2 != 0) return "has a reserved word that is not zero";
    if (!all_finite(leaf.v0) || !all_finite(leaf.v1) || !all_finite(leaf.v2)) return "is not finite";
    return primitives.reach(leaf.primitive);
}

const char* wrong_with(const Triangle4& leaf, PrimitiveSet& primitives) {
    for (std::uint32_t slot = 0; slot < 4; ++slot) {
        const std::array<float, 9> values = {leaf.v0_x[slot], leaf.v0_y[slot], leaf.v0_z[slot],
                                             leaf.v1_x[slot], leaf.v1_y[slot], leaf.v1_z[slot],
                                             leaf.v2_x[slot], leaf.v2_y[slot], leaf.v2_z[slot]};
        if (leaf.primitive[slot] == BOXWOOD_NONE) {
            if (slot == 0) return "has no triangle";
            if (!all_zero(values)) return "has an unused slot that is not zero";
            continue;
        }
        // BOXWOOD_NONE is the largest value, so a used slot behind an unused one fails here too.
        if (slot > 0 && leaf.primitive[slot] <= leaf.primitive[slot - 1]) return "has triangles out of order";
        if (!all_finite(values)) return "has a triangle that is not finite";
        if (const char* what = primitives.reach(leaf.primitive[slot])) return what;
    }
    return nullptr;
}

/// The arrays of one layout, with their names for messages.
template <class Node_, class Leaf_>
struct Arrays {
    using Node = Node_;
    using Leaf = Leaf_;
    static constexpr bool is_wide = std::is_same_v<Node, Wide8Node>;
    static constexpr std::uint64_t leaf_size = is_wide ? 4 : 1; ///< Most triangles in a leaf.

    const std::vector<Node>& nodes;
    std::string_view nodes_name;
    const std::vector<Leaf>& leaves;
    std::string_view leaves_name;
    const std::vector<Node>& top;
    std::string_view top_name;
};

/// Checks the nodes and leaves of one bottom-level tree and returns its depth.
template <class LayoutArrays>
std::uint32_t walk_bottom(Walker<typename LayoutArrays::Node>& walker, std::uint32_t root, const LayoutArrays& arrays,
                          PrimitiveSet& primitives, const std::string& file) {
    return walker.walk(root, [&](std::uint32_t leaf) {
        const char* what = wrong_with(arrays.leaves[leaf], primitives);
        if (what) throw InputError(file, element(arrays.leaves_name, leaf), what);
    });
}

/// The same of one that must hold all `primitives`.
template <class LayoutArrays>
std::uint32_t check_bottom(Walker<typename LayoutArrays::Node>& walker, std::uint32_t root, const LayoutArrays& arrays,
                           PrimitiveSet primitives, const std::string& file) {
    const std::uint32_t depth = walk_bottom(walker, root, arrays, primitives, file);
    if (primitives.reached != primitives.count) {
        throw InputError(file, element(arrays.nodes_name, root),
                         "is the root of " + std::to_string(primitives.reached) + " primitives instead of " +
                             std::to_string(primitives.count));
    }
    return depth;
}

void check_depth(const char* field, std::uint32_t stated, std::uint32_t found, const std::string& file) {
    if (stated == found) return;
    throw InputError(file, field, "is " + std::to_string(stated) + " but the tree has " + std::to_string(found));
}

void check_instance(const InstanceRecord& record, const Instance& instance, std::uint64_t index,
                    const std::string& file) {
    const auto fail = [&](const char* what) { throw InputError(file, element("instances", index), what); };
    if (record.mesh != instance.mesh) fail("names another mesh than the scene");
    if (!all_zero(record.reserved)) fail("has a reserved word that is not zero");
    if (!all_finite(record.to_object) || !all_finite(record.to_world)) fail("has a matrix that is not finite");
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) {
            if (record.to_world[4 * row + column] != instance.transform[column][row]) {
                fail("has another transform than the scene");
            }
        }
    }
}

/// The local trees of influence areas, each over some of the primitives of the global one. Returns the greatest depth.
template <class LayoutArrays>
std::uint32_t check_local_trees(Walker<typename LayoutArrays::Node>& walker, const TreeImage& tree, std::uint64_t count,
                                const LayoutArrays& arrays, const std::string& file) {
    std::uint32_t deepest = 0;
    std::vector<bool> seen(tree.areas.empty() ? 0 : count);
    std::vector<std::uint32_t> named;
    for (std::size_t i = 0; i < tree.areas.size(); ++i) {
        const std::uint32_t root = tree.areas[i].root;
        const auto fail = [&](const char* what) { throw InputError(file, element("areas", i) + ".root", what); };
        if (root >= arrays.nodes.size()) fail("is out of range");
        if (walker.reached(root)) fail("is a node of another tree");
        PrimitiveSet primitives{seen, 0, count, 0, &named};
        deepest = std::max(deepest, walk_bottom(walker, root, arrays, primitives, file));
        // One by one: all marks of a large scene for each of many small trees would take their product.
        for (const std::uint32_t primitive : named) seen[primitive] = false;
        named.clear();
    }
    return deepest;
}

template <class LayoutArrays>
void check_one_level(const TreeImage& tree, const Scene& scene, const LayoutArrays& arrays, const std::string& file) {
    if (!arrays.top.empty() || !tree.instances.empty()) {
        throw InputError(file, std::string(arrays.top_name), "and instances must be empty for one level");
    }
    const std::uint64_t count = scene.instanced_triangle_count();
    // Also bounds the marks: a small file can ask for any number of instanced triangles.
    if (count > LayoutArrays::leaf_size * arrays.leaves.size()) {
        throw InputError(file, std::string(arrays.leaves_name), "has too few leaves for the scene");
    }
    if (arrays.nodes.empty() && count > 0) {
        throw InputError(file, std::string(arrays.nodes_name), "is empty but the scene is not");
    }
    std::uint32_t depth = 0;
    std::vector<bool> seen(count);
    Walker<typename LayoutArrays::Node> walker(arrays.nodes, arrays.nodes_name, arrays.leaves.size(),
                                               LayoutArrays::is_wide, file);
    if (!arrays.nodes.empty()) depth = check_bottom(walker, 0, arrays, {seen, 0, count}, file);
    depth = std::max(depth, check_local_trees(walker, tree, count, arrays, file));
    check_depth("bottom_depth", tree.bottom_depth, depth, file);
    check_depth("top_depth", tree.top_depth, 0, file);
}

/// One level over several instances: their triangles lie one after another in the flattened scene.
void check_first_triangles(const TreeImage& tree, const Scene& scene, const std::string& file) {
    const bool needed = tree.levels == Levels::one && scene.instances.size() > 1;
    const std::size_t wanted = needed ? scene.instances.size() + 1 : 0;
    if (tree.first_triangles.size() != wanted) {
        throw InputError(file, "first_triangles", "must have " + std::to_string(wanted) + " elements for this scene");
    }
    std::uint64_t first = 0;
    for (std::size_t i = 0; i < wanted; ++i) {
        if (tree.first_triangles[i] != first) {
            throw InputError(file, element("first_triangles", i), "is not where the instance's triangles start");
        }
        if (i < scene.instances.size()) first += scene.meshes[scene.instances[i].mesh].triangles.size();
    }
}

void check_sphere(const TreeImage& tree, const Scene& scene, const std::string& file) {
    const SceneSphere sphere = scene_sphere(scene);
    if (!std::ranges::equal(tree.sphere.center, sphere.center) || tree.sphere.radius != sphere.radius)
        throw InputError(file, "sphere", "is not that of the scene");
}

/// The trees of all meshes that have an instance; one root per mesh, no node shared between meshes.
template <class LayoutArrays>
void check_bottom_level(const TreeImage& tree, const Scene& scene, const LayoutArrays& arrays,
                        const std::string& file) {
    std::vector<std::uint64_t> first(scene.meshes.size() + 1);
    for (std::size_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
        first[mesh + 1] = first[mesh] + scene.meshes[mesh].triangles.size();
    }
    std::vector<bool> seen(first.back());
    std::vector<std::uint32_t> roots(scene.meshes.size(), BOXWOOD_NONE);
    Walker<typename LayoutArrays::Node> walker(arrays.nodes, arrays.nodes_name, arrays.leaves.size(),
                                               LayoutArrays::is_wide, file);
    std::uint32_t deepest = 0;
    std::size_t walked = 0;
    for (std::size_t i = 0; i < tree.instances.size(); ++i) {
        const InstanceRecord& record = tree.instances[i];
        check_instance(record, scene.instances[i], i, file);
        const auto fail = [&](const char* what) { throw InputError(file, element("instances", i) + ".root", what); };
        if (record.root >= arrays.nodes.size()) fail("is out of range");
        if (record.root == roots[record.mesh]) continue;
        if (roots[record.mesh] != BOXWOOD_NONE) fail("differs from that of another instance of the mesh");
        if (walker.reached(record.root)) fail("is a node of another mesh's tree");
        roots[record.mesh] = record.root;
        const PrimitiveSet primitives{seen, first[record.mesh], first[record.mesh + 1] - first[record.mesh]};
        deepest = std::max(deepest, check_bottom(walker, record.root, arrays, primitives, file));
        ++walked;
    }
    // A mesh without an instance has no root to walk from, and may be the deepest.
    const bool exact = walked == scene.meshes.size();
    if (exact || tree.bottom_depth < deepest) check_depth("bottom_depth", tree.bottom_depth, deepest, file);
    if (tree.bottom_depth > arrays.nodes.size()) throw InputError(file, "bottom_depth", "exceeds the number of nodes");
}

template <class LayoutArrays>
void check_top_level(const TreeImage& tree, const LayoutArrays& arrays, const std::string& file) {
    std::uint32_t depth = 0;
    std::size_t reached = 0;
    if (!arrays.top.empty()) {
        Walker<typename LayoutArrays::Node> walker(arrays.top, arrays.top_name, tree.instances.size(), false, file);
        depth = walker.walk(0, [&](std::uint32_t) { ++reached; });
    }
    if (reached != tree.instances.size()) {
        throw InputError(file, std::string(arrays.top_name), "does not reach every instance");
    }
    check_depth("top_depth", tree.top_depth, depth, file);
}

template <class LayoutArrays>
void check_layout(const TreeImage& tree, const Scene& scene, const LayoutArrays& arrays, const std::string& file) {
    if (tree.levels == Levels::one) return check_one_level(tree, scene, arrays, file);
    if (tree.instances.size() != scene.instances.size()) {
        throw InputError(file, "instances", "are not as many as in the scene");
    }
    check_bottom_level(tree, scene, arrays, file);
    check_top_level(tree, arrays, file);
}

} // namespace

std::string_view name(Layout layout) { return word_of(layouts, layout); }
std::string_view name(Levels levels) { return word_of(level_choices, levels); }
Layout to_layout(std::string_view word) { return value_of(layouts, "layout", word); }
Levels to_levels(std::string_view word) { return value_of(level_choices, "levels", word); }

void validate(const TreeImage& tree, const Scene& scene, const std::string& file) {
    if (tree.levels == Levels::automatic) throw InputError(file, "levels", "must be one or two");
    if (tree.layout == Layout::automatic) throw InputError(file, "layout", "must be binary or wide8");
    const bool oriented = tree.bounds != Bounds::aabb;
    if (oriented && tree.layout != Layout::binary)
        throw InputError(file, "bounds", "must be aabb for layout " + std::string(name(tree.layout)));
    const auto refuse = [&](bool has, const char* arrays) {
        if (has) throw InputError(file, arrays, "must be empty for this layout, these levels and these bounds");
    };
    refuse(!tree.areas.empty() && (oriented || tree.levels == Levels::two), "areas");
    const bool binary = tree.layout == Layout::binary;
    refuse(!oriented && !(tree.oriented_nodes.empty() && tree.oriented_top.empty()), "oriented_nodes and oriented_top");
    refuse((oriented || !binary) && !(tree.binary_nodes.empty() && tree.binary_top.empty()),
           "binary_nodes and binary_top");
    refuse(!binary && !tree.triangles.empty(), "triangles");
    refuse(binary && !(tree.wide_nodes.empty() && tree.blocks.empty() && tree.wide_top.empty()),
           "wide_nodes, blocks and wide_top");
    if (oriented) {
        const Arrays<OrientedNode, Triangle> arrays{tree.oriented_nodes, "oriented_nodes",  tree.triangles,
                                                    "triangles",         tree.oriented_top, "oriented_top"};
        check_layout(tree, scene, arrays, file);
    } else if (binary) {
        const Arrays<BinaryNode, Triangle> arrays{tree.binary_nodes, "binary_nodes",  tree.triangles,
                                                  "triangles",       tree.binary_top, "binary_top"};
        check_layout(tree, scene, arrays, file);
    } else {
        const Arrays<Wide8Node, Triangle4> arrays{tree.wide_nodes, "wide_nodes",  tree.blocks,
                                                  "blocks",        tree.wide_top, "wide_top"};
        check_layout(tree, scene, arrays, file);
    }
    check_first_triangles(tree, scene, file);
    check_sphere(tree, scene, file);
    check_areas(tree, file);
}

} // namespace boxwood
