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

/// Nodes and leaves of the `wide8` layout. The root of tree t is node t.
struct WideLayout {
    Buffer<Wide8Node> nodes;
    Buffer<Triangle4> blocks; ///< Empty for a tree over instances.
    std::uint32_t depth = 0;  ///< Nodes on the longest path from a root.
};

/// Nodes and leaves of the `binary` layout. The root of tree t is node offsets[t].
struct BinaryLayout {
    Buffer<BinaryNode> nodes;
    Buffer<Triangle> triangles; ///< By sorted position; empty for a tree over instances.
    std::uint32_t depth = 0;
};

/// Collapses binary trees over triangles to wide nodes at least expected cost (Ylitie et al. 2017, section 3.1). Each
/// subtree of up to four triangles is one leaf: a block costs the same however many of its slots are filled. One pass for the costs, then a few launches per level of the result; waits once
/// per level for its size. `volumes` as from aabb_volumes. Leaves name triangles by their index within the tree, or by `names`
/// where that is not empty; names ascend within each tree. Throws CapacityError when the result does not fit. O(n).
WideLayout collapse_wide(Device& device, const Topology& topology, BufferView<const Aabb> volumes,
                         const Geometry& geometry, BufferView<const std::uint32_t> names = {});

/// The same for one tree over instances: leaves are single instances.
WideLayout collapse_wide(Device& device, const Topology& topology, BufferView<const Aabb> volumes);

/// The `binary` layout of trees over triangles: both child boxes in the parent. `names` as for collapse_wide. O(n).
BinaryLayout collapse_binary(Device& device, const Topology& topology, BufferView<const Aabb> volumes,
                             const Geometry& geometry, BufferView<const std::uint32_t> names = {});

/// The same for one tree over instances.
BinaryLayout collapse_binary(Device& device, const Topology& topology, BufferView<const Aabb> volumes);

/// Nodes and leaves of the `binary` layout with oriented boxes. The root of tree t is node offsets[t].
struct OrientedLayout {
    Buffer<OrientedNode> nodes;
    Buffer<Triangle> triangles; ///< By sorted position; empty for a tree over instances.
    std::uint32_t depth = 0;
};

/// The `binary` layout with oriented boxes: a node that keeps its AABB takes it from `volumes`, the others from `boxes`
/// (as from obb_volumes). O(n).
OrientedLayout collapse_oriented(Device& device, const Topology& topology, BufferView<const Aabb> volumes,
                                 BufferView<const Obb> boxes, const Geometry& geometry);

/// The same for one tree over instances.
OrientedLayout collapse_oriented(Device& device, const Topology& topology, BufferView<const Aabb> volumes,
                                 BufferView<const Obb> boxes);

} // namespace boxwood
