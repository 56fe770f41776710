// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "boxwood/geometry.hpp"
#include "boxwood/topology.hpp"
#include "shared/aabb.h"
#include "shared/node.h"
#include "shared/obb.h"
#include "shared/triangle.h"

namespace boxwood {

/// Nodes and leaves of trees as traversal reads them.
template <class Node, class Leaf>
struct CollapsedTrees {
    Buffer<Node> nodes;
    Buffer<Leaf> leaves;     ///< Empty for a tree over instances.
    std::uint32_t depth = 0; ///< Nodes on the longest path from a root.
};

/// The `wide8` layout: blocks of four triangles. The root of tree t is node t.
using WideLayout = CollapsedTrees<Wide8Node, Triangle4>;
/// The `binary` layout: triangles by sorted position. The root of tree t is node offsets[t].
using BinaryLayout = CollapsedTrees<BinaryNode, Triangle>;
/// The same with oriented boxes.
using OrientedLayout = CollapsedTrees<OrientedNode, Triangle>;

/// Collapses binary trees to wide nodes at least expected cost (Ylitie et al. 2017, section 3.1). Over the triangles of
/// `geometry` each subtree of up to four is one leaf: a block costs the same however many of its slots are filled.
/// Without `geometry` one tree over instances: leaves are single ones, by their index. One pass for the costs, then a
/// few launches per level of the result; waits once per level for its size. `volumes` as from aabb_volumes. Leaves name
/// triangles by their index within the tree, or by `names` where that is not empty; names ascend within each tree.
/// Throws CapacityError when the result does not fit. O(n).
WideLayout collapse_wide(Device& device, const Topology& topology, BufferView<const Aabb> volumes,
                         const Geometry* geometry = nullptr, BufferView<const std::uint32_t> names = {});

/// The `binary` layout of such trees: both child boxes in the parent. O(n).
BinaryLayout collapse_binary(Device& device, const Topology& topology, BufferView<const Aabb> volumes,
                             const Geometry* geometry = nullptr, BufferView<const std::uint32_t> names = {});

/// The `binary` layout with oriented boxes: a node that keeps its AABB takes it from `volumes`, the others from `boxes`
/// (as from obb_volumes). O(n).
OrientedLayout collapse_oriented(Device& device, const Topology& topology, BufferView<const Aabb> volumes,
                                 BufferView<const Obb> boxes, const Geometry* geometry = nullptr);

} // namespace boxwood
