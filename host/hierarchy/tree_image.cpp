// SPDX-License-Identifier: MIT
#include "boxwood/tree_image.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "boxwood/error.hpp"

namespace boxwood {

namespace {

constexpr std::array<std::pair<std::string_view, Layout>, 2> layouts = {
    {{"binary", Layout::binary}, {"wide8", Layout::wide8}}};
constexpr std::array<std::pair<std::string_view, Levels>, 3> level_choices = {
    {{"auto", Levels::automatic}, {"one", Levels::one}, {"two", Levels::two}}};

template <class Table, class Value>
std::string_view word_of(const Table& table, Value value) {
    const auto found = std::ranges::find(table, value, [](const auto& entry) { return entry.second; });
    return found == table.end() ? std::string_view("unknown") : found->first;
}

template <class Table>
auto value_of(const Table& table, std::string_view option, std::string_view word) {
    const auto found = std::ranges::find(table, word, [](const auto& entry) { return entry.first; });
    if (found != table.end()) return found->second;
    std::string words;
    for (const auto& entry : table) words.append(words.empty() ? "" : ", ").append(entry.first);
    throw InputError(std::string(option), std::string(word), "unknown word; use one of " + words);
}

std::string element(std::string_view array, std::uint64_t index) {
    return std::string(array) + "[" + std::to_string(index) + "]";
}

// The two layouts seen alike: slots in use, and the box and reference of a slot.

std::uint32_t used_slots(const BinaryNode& node) { return node.child[1] == BOXWOOD_NONE ? 1 : 2; }
std::uint32_t used_slots(const Wide8Node& node) { return node.count; }

Aabb slot_box(const BinaryNode& node, std::uint32_t slot) { return node.bounds[slot]; }
Aabb slot_box(const Wide8Node& node, std::uint32_t slot) {
    return {{node.min_x[slot], node.min_y[slot], node.min_z[slot]},
            {node.max_x[slot], node.max_y[slot], node.max_z[slot]}};
}

bool is_ordered(const Aabb& box) { // false for NaN
    return box.min[0] <= box.max[0] && box.min[1] <= box.max[1] && box.min[2] <= box.max[2];
}

bool is_empty(const Aabb& box) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    return std::ranges::all_of(box.min, [](float x) { return x == infinity; }) &&
           std::ranges::all_of(box.max, [](float x) { return x == -infinity; });
}

template <class Range>
bool all_zero(const Range& values) {
    return std::ranges::all_of(values, [](auto value) { return value == 0; });
}

template <class Range>
bool all_finite(const Range& values) {
    return std::ranges::all_of(values, [](float value) { return std::isfinite(value); });
}

/// Walks the trees of one node array from their roots; what it has reached stays marked from tree to tree.
template <class Node>
class Walker {
public:
    /// `parents_first`: a child must come after its parent in the array.
    Walker(std::span<const Node> nodes, std::string_view array, std::uint64_t leaf_count, bool parents_first,
           const std::string& file)
        : nodes_(nodes), array_(array), parents_first_(parents_first), file_(file), node_seen_(nodes.size()),
          leaf_seen_(leaf_count) {}

    /// Checks the tree under `root`, calls `leaf(index)` for each leaf, and returns the number of nodes on the longest
    /// path. Not recursive: a hostile tree may be as deep as it has nodes.
    template <class Leaf>
    std::uint32_t walk(std::uint32_t root, Leaf&& leaf) {
        std::uint32_t deepest = 0;
        node_seen_[root] = true;
        stack_.assign(1, {root, 1});
        while (!stack_.empty()) {
            const auto [index, depth] = stack_.back();
            stack_.pop_back();
            deepest = std::max(deepest, depth);
            const Node& node = nodes_[index];
            check_slots(node, index, index == root);
            for (std::uint32_t slot = 0; slot < used_slots(node); ++slot) {
                const std::uint32_t child = node.child[slot];
                if (child & BOXWOOD_LEAF) {
                    leaf(reach_leaf(child & ~BOXWOOD_LEAF, index, slot));
                } else {
                    reach_node(child, index, slot);
                    stack_.push_back({child, depth + 1});
                }
            }
        }
        return deepest;
    }

    /// Whether a walk has been at `node`.
    bool reached(std::uint32_t node) const { return node_seen_[node]; }

private:
    struct Visit {
        std::uint32_t node;
        std::uint32_t depth;
    };

    [[noreturn]] void fail(std::uint32_t index, const char* what) const {
        throw InputError(file_, element(array_, index), what);
    }
    [[noreturn]] void fail(std::uint32_t index, std::uint32_t slot, const char* what) const {
        throw InputError(file_, element(element(array_, index) + ".child", slot), what);
    }

    void check_slots(const Node& node, std::uint32_t index, bool is_root) const {
        const std::uint32_t used = used_slots(node);
        if (used == 0 || used > std::size(node.child)) fail(index, "has a child count out of range");
        if (!all_zero(node.reserved)) fail(index, "has a reserved word that is not zero");
        if constexpr (std::is_same_v<Node, BinaryNode>) {
            if (used == 1 && !(is_root && (node.child[0] & BOXWOOD_LEAF))) {
                fail(index, "has one child, which only the root over one primitive may have");
            }
        }
        for (std::uint32_t slot = 0; slot < std::size(node.child); ++slot) {
            const bool none = node.child[slot] == BOXWOOD_NONE;
            if (slot >= used && !(none && is_empty(slot_box(node, slot)))) fail(index, slot, "is unused but not empty");
            if (slot < used && none) fail(index, slot, "refers to nothing");
            if (slot < used && !is_ordered(slot_box(node, slot)))
                fail(index, slot, "has a box that is NaN or inverted");
        }
    }

    std::uint32_t reach_leaf(std::uint32_t leaf, std::uint32_t index, std::uint32_t slot) {
        if (leaf >= leaf_seen_.size()) fail(index, slot, "refers to a leaf out of range");
        if (leaf_seen_[leaf]) fail(index, slot, "refers to a leaf that another slot refers to");
        leaf_seen_[leaf] = true;
        return leaf;
    }

    void reach_node(std::uint32_t child, std::uint32_t index, std::uint32_t slot) {
        if (child >= nodes_.size()) fail(index, slot, "refers to a node out of range");
        if (node_seen_[child]) fail(index, slot, "refers to a node that is reached twice");
        if (parents_first_ && child <= index) fail(index, slot, "refers to a node that comes before its parent");
        node_seen_[child] = true;
    }

    std::span<const Node> nodes_;
    std::string_view array_;
    bool parents_first_;
    const std::string& file_;
    std::vector<bool> node_seen_;
    std::vector<bool> leaf_seen_;
    std::vector<Visit> stack_;
};

/// The primitives that one tree must hold, `count` from `first` in the marks, each in exactly one leaf.
struct PrimitiveSet {
    std::vector<bool>& seen;
    std::uint64_t first;
    std::uint64_t count;
    std::uint64_t reached = 0;

    /// Marks a primitive; returns what is wrong with it, or null.
    const char* reach(std::uint32_t primitive) {
        if (primitive >= count) return "names a primitive out of range";
        if (seen[first + primitive]) return "names a primitive that another leaf names";
        seen[first + primitive] = true;
        ++reached;
        return nullptr;
    }
};

const char* wrong_with(const Triangle& leaf, PrimitiveSet& primitives) {
    if (leaf.reserved1 != 0 || leaf.reserved2 != 0) return "has a reserved word that is not zero";
    if (!all_finite(leaf.v0) || !all_finite(leaf.edge1) || !all_finite(leaf.edge2)) return "is not finite";
    return primitives.reach(leaf.primitive);
}

const char* wrong_with(const Triangle4& leaf, PrimitiveSet& primitives) {
    for (std::uint32_t slot = 0; slot < 4; ++slot) {
        const std::array<float, 9> values = {leaf.v0_x[slot],    leaf.v0_y[slot],    leaf.v0_z[slot],
                                             leaf.edge1_x[slot], leaf.edge1_y[slot], leaf.edge1_z[slot],
                                             leaf.edge2_x[slot], leaf.edge2_y[slot], leaf.edge2_z[slot]};
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

/// Checks one bottom-level tree and returns its depth.
template <class Node, class Leaf>
std::uint32_t check_bottom(Walker<Node>& walker, std::uint32_t root, const std::vector<Leaf>& leaves,
                           std::string_view leaf_array, PrimitiveSet primitives, const std::string& file) {
    const std::uint32_t depth = walker.walk(root, [&](std::uint32_t leaf) {
        if (const char* what = wrong_with(leaves[leaf], primitives))
            throw InputError(file, element(leaf_array, leaf), what);
    });
    if (primitives.reached != primitives.count) {
        throw InputError(file, element("root", root),
                         "reaches " + std::to_string(primitives.reached) + " of " + std::to_string(primitives.count) +
                             " primitives");
    }
    return depth;
}

void check_depth(std::string_view field, std::uint32_t stated, std::uint32_t found, const std::string& file) {
    if (stated == found) return;
    throw InputError(file, std::string(field),
                     "is " + std::to_string(stated) + " but the tree has " + std::to_string(found));
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

template <class Node, class Leaf>
void check_one_level(const TreeImage& tree, const Scene& scene, const std::vector<Node>& nodes,
                     std::string_view node_array, const std::vector<Leaf>& leaves, std::string_view leaf_array,
                     const std::string& file) {
    constexpr std::uint64_t leaf_size = std::is_same_v<Leaf, Triangle> ? 1 : 4;
    const std::uint64_t count = scene.instanced_triangle_count();
    // Also bounds the marks: a small file can ask for any number of instanced triangles.
    if (count > leaf_size * leaves.size())
        throw InputError(file, std::string(leaf_array), "has too few leaves for the scene");
    if (nodes.empty() && count > 0) throw InputError(file, std::string(node_array), "is empty but the scene is not");
    std::uint32_t depth = 0;
    if (!nodes.empty()) {
        std::vector<bool> seen(count);
        Walker<Node> walker(nodes, node_array, leaves.size(), leaf_size > 1, file);
        depth = check_bottom(walker, 0, leaves, leaf_array, {seen, 0, count}, file);
    }
    check_depth("bottom_depth", tree.bottom_depth, depth, file);
    check_depth("top_depth", tree.top_depth, 0, file);
}

/// The trees of all meshes that have an instance; one root per mesh, no node shared between meshes.
template <class Node, class Leaf>
void check_bottom_level(const TreeImage& tree, const Scene& scene, const std::vector<Node>& nodes,
                        std::string_view node_array, const std::vector<Leaf>& leaves, std::string_view leaf_array,
                        const std::string& file) {
    std::vector<std::uint64_t> first(scene.meshes.size() + 1);
    for (std::size_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
        first[mesh + 1] = first[mesh] + scene.meshes[mesh].triangles.size();
    }
    std::vector<bool> seen(first.back());
    std::vector<std::uint32_t> roots(scene.meshes.size(), BOXWOOD_NONE);
    Walker<Node> walker(nodes, node_array, leaves.size(), std::is_same_v<Node, Wide8Node>, file);
    std::uint32_t deepest = 0;
    std::size_t walked = 0;
    for (std::size_t i = 0; i < tree.instances.size(); ++i) {
        const InstanceRecord& record = tree.instances[i];
        check_instance(record, scene.instances[i], i, file);
        const auto fail = [&](const char* what) { throw InputError(file, element("instances", i) + ".root", what); };
        if (record.root >= nodes.size()) fail("is out of range");
        if (record.root == roots[record.mesh]) continue;
        if (roots[record.mesh] != BOXWOOD_NONE) fail("differs from that of another instance of the mesh");
        if (walker.reached(record.root)) fail("is a node of another mesh's tree");
        roots[record.mesh] = record.root;
        const PrimitiveSet primitives{seen, first[record.mesh], first[record.mesh + 1] - first[record.mesh]};
        deepest = std::max(deepest, check_bottom(walker, record.root, leaves, leaf_array, primitives, file));
        ++walked;
    }
    // A mesh without an instance has no root to walk from, and may be the deepest.
    if (walked == scene.meshes.size()) check_depth("bottom_depth", tree.bottom_depth, deepest, file);
    if (tree.bottom_depth < deepest) check_depth("bottom_depth", tree.bottom_depth, deepest, file);
    if (tree.bottom_depth > nodes.size()) throw InputError(file, "bottom_depth", "exceeds the number of nodes");
}

template <class Node>
void check_top_level(const TreeImage& tree, const std::vector<Node>& top, std::string_view array,
                     const std::string& file) {
    std::uint32_t depth = 0;
    std::size_t reached = 0;
    if (!top.empty()) {
        Walker<Node> walker(top, array, tree.instances.size(), false, file);
        depth = walker.walk(0, [&](std::uint32_t) { ++reached; });
    }
    if (reached != tree.instances.size()) throw InputError(file, std::string(array), "does not reach every instance");
    check_depth("top_depth", tree.top_depth, depth, file);
}

template <class Node, class Leaf>
void check_levels(const TreeImage& tree, const Scene& scene, const std::vector<Node>& nodes,
                  std::string_view node_array, const std::vector<Leaf>& leaves, std::string_view leaf_array,
                  const std::vector<Node>& top, std::string_view top_array, const std::string& file) {
    if (tree.levels == Levels::one) {
        if (!top.empty() || !tree.instances.empty()) {
            throw InputError(file, std::string(top_array), "and instances must be empty for one level");
        }
        check_one_level(tree, scene, nodes, node_array, leaves, leaf_array, file);
        return;
    }
    if (tree.instances.size() != scene.instances.size()) {
        throw InputError(file, "instances", "are not as many as in the scene");
    }
    check_bottom_level(tree, scene, nodes, node_array, leaves, leaf_array, file);
    check_top_level(tree, top, top_array, file);
}

} // namespace

std::string_view name(Layout layout) { return word_of(layouts, layout); }
std::string_view name(Levels levels) { return word_of(level_choices, levels); }
Layout to_layout(std::string_view word) { return value_of(layouts, "layout", word); }
Levels to_levels(std::string_view word) { return value_of(level_choices, "levels", word); }

void validate(const TreeImage& tree, const Scene& scene, const std::string& file) {
    if (tree.levels == Levels::automatic) throw InputError(file, "levels", "must be one or two");
    const bool has_binary = !tree.binary_nodes.empty() || !tree.triangles.empty() || !tree.binary_top.empty();
    const bool has_wide = !tree.wide_nodes.empty() || !tree.blocks.empty() || !tree.wide_top.empty();
    if (tree.layout == Layout::binary) {
        if (has_wide) throw InputError(file, "wide_nodes, blocks and wide_top", "must be empty for layout binary");
        check_levels(tree, scene, tree.binary_nodes, "binary_nodes", tree.triangles, "triangles", tree.binary_top,
                     "binary_top", file);
    } else {
        if (has_binary)
            throw InputError(file, "binary_nodes, triangles and binary_top", "must be empty for layout wide8");
        check_levels(tree, scene, tree.wide_nodes, "wide_nodes", tree.blocks, "blocks", tree.wide_top, "wide_top",
                     file);
    }
}

} // namespace boxwood
