// SPDX-License-Identifier: MIT
// Checks trees of either layout node by node, for validate(TreeImage).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "boxwood/error.hpp"
#include "shared/node.h"

namespace boxwood::detail::tree_check {

inline std::string element(std::string_view array, std::uint64_t index) {
    return std::string(array) + "[" + std::to_string(index) + "]";
}

// The layouts seen alike: slots in use, and the reference, box and faults of a slot.

inline std::uint32_t used_slots(const BinaryNode& node) { return node.child[1] == BOXWOOD_NONE ? 1 : 2; }
inline std::uint32_t used_slots(const OrientedNode& node) { return node.child[1] == BOXWOOD_NONE ? 1 : 2; }
inline std::uint32_t used_slots(const Wide8Node& node) { return node.count; }

template <class Node>
std::uint32_t reference_of(const Node& node, std::uint32_t slot) {
    constexpr std::uint32_t marks = std::is_same_v<Node, OrientedNode> ? BOXWOOD_ALIGNED : 0u;
    return node.child[slot] & ~marks;
}

inline Aabb slot_box(const BinaryNode& node, std::uint32_t slot) { return node.bounds[slot]; }
inline Aabb slot_box(const Wide8Node& node, std::uint32_t slot) {
    return {{node.min_x[slot], node.min_y[slot], node.min_z[slot]},
            {node.max_x[slot], node.max_y[slot], node.max_z[slot]}};
}

/// Of an aligned volume.
inline Aabb slot_box(const OrientedNode& node, std::uint32_t slot) {
    const float* box = node.volume[slot];
    return {{box[0], box[1], box[2]}, {box[3], box[4], box[5]}};
}

inline bool is_ordered(const Aabb& box) { // false for NaN
    return box.min[0] <= box.max[0] && box.min[1] <= box.max[1] && box.min[2] <= box.max[2];
}

inline bool is_empty(const Aabb& box) {
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

inline bool is_padded(const OrientedNode& node, std::uint32_t slot) {
    return all_zero(std::span(node.volume[slot]).subspan(6));
}

// What is wrong with a node's reserved words, or with the volume of a slot in use, or null; and whether the volume of a
// slot that is not is the empty one.

inline const char* wrong_with_words(const OrientedNode&) { return nullptr; }
template <class Node>
const char* wrong_with_words(const Node& node) {
    return all_zero(node.reserved) ? nullptr : "has a reserved word that is not zero";
}

template <class Node>
const char* wrong_with_volume(const Node& node, std::uint32_t slot) {
    return is_ordered(slot_box(node, slot)) ? nullptr : "has a box that is NaN or inverted";
}
inline const char* wrong_with_volume(const OrientedNode& node, std::uint32_t slot) {
    if (node.child[slot] & BOXWOOD_ALIGNED) {
        if (!is_ordered(slot_box(node, slot))) return "has a box that is NaN or inverted";
        return is_padded(node, slot) ? nullptr : "has an aligned box with numbers behind it that are not zero";
    }
    const float* box = node.volume[slot];
    if (!all_finite(node.volume[slot])) return "has an oriented box that is not finite";
    for (int k = 0; k < 3; ++k) {
        if (box[3 + k] < 0.0f) return "has an oriented box of negative extent";
        if (box[6 + k] == 0.0f && box[9 + k] == 0.0f && box[12 + k] == 0.0f)
            return "has an oriented box with an axis of zero";
    }
    return nullptr;
}

template <class Node>
bool has_empty_volume(const Node& node, std::uint32_t slot) {
    return is_empty(slot_box(node, slot));
}
inline bool has_empty_volume(const OrientedNode& node, std::uint32_t slot) {
    return is_empty(slot_box(node, slot)) && is_padded(node, slot);
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
                const std::uint32_t child = reference_of(node, slot);
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
        if (const char* what = wrong_with_words(node)) fail(index, what);
        if constexpr (!std::is_same_v<Node, Wide8Node>) {
            if (used == 1 && !(is_root && (node.child[0] & BOXWOOD_LEAF))) {
                fail(index, "has one child, which only the root over one primitive may have");
            }
        }
        for (std::uint32_t slot = 0; slot < std::size(node.child); ++slot) {
            const bool none = node.child[slot] == BOXWOOD_NONE;
            if (slot >= used) {
                if (!none || !has_empty_volume(node, slot)) fail(index, slot, "is unused but not empty");
                continue;
            }
            if (none) fail(index, slot, "refers to nothing");
            if (const char* what = wrong_with_volume(node, slot)) fail(index, slot, what);
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

} // namespace boxwood::detail::tree_check
