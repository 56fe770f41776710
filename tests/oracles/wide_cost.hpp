// SPDX-License-Identifier: MIT
// The least cost of collapsing a binary tree to wide nodes, by trying every way.
#pragma once

#include <vector>

#include "oracles/tree_checker.hpp"
#include "shared/aabb.h"

namespace boxwood::test {

/// What tests cost, and how many primitives make a leaf.
struct CostModel {
    double node, leaf;
    std::uint32_t leaf_size;
};

/// Surface area in double.
double area_of(const Aabb& box);

/// Least expected cost, per ray that hits the root's box, of covering tree `tree` by nodes of up to eight children: the
/// node at the root, and below every set of two to eight binary nodes that cover it, each a leaf (always when it has
/// few enough primitives) or a node again. Takes time exponential in the size of the tree: up to about 60 primitives.
/// The root must have an area.
double least_cost(const HostTopology& topology, const std::vector<Aabb>& volumes, std::uint32_t tree, CostModel model);

} // namespace boxwood::test
