// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "boxwood/quality.hpp"
#include "shared/instance.h"
#include "volumes/binary_trees.hpp"

namespace boxwood {

/// Metrics of all trees by the boxes that its nodes have: oriented ones where `boxes` is not empty and the node does
/// not keep its AABB.
struct TreeQuality {
    LevelQuality sums;
    std::uint64_t nodes = 0;       ///< Nodes that `sums` is over.
    std::vector<double> root_area; ///< Per tree.
    std::vector<double> sah;       ///< Per tree: expected nodes and primitives tested by a ray that hits its root box.
    std::vector<double> inner_sah; ///< Per tree: the part of the inner nodes.
    std::vector<double> leaf_area; ///< By primitive, where asked for.
};

/// Waits. Sums are pairwise and in a fixed order. O(n).
TreeQuality measure(Device& device, const BinaryTrees& trees, bool leaf_areas = false);

/// A power of two near the largest extent of any tree: lengths over it neither overflow when multiplied nor lose bits.
float unit_of_lengths(Device& device, const BinaryTrees& trees);

/// Sums over both levels.
LevelQuality total(const TreeQuality& bottom, const TreeQuality& top);

/// The SAH cost of two levels: top nodes, then each instance's bottom tree weighted by the probability to reach its
/// box. `top` has its leaf areas.
double two_level_sah(const TreeQuality& bottom, const TreeQuality& top, const std::vector<InstanceRecord>& instances);

} // namespace boxwood
