// SPDX-License-Identifier: MIT
#pragma once

#include "boxwood/topology.hpp"
#include "shared/aabb.h"
#include "shared/obb.h"

namespace boxwood {

/// Binary trees with their boxes: what every layout is made from.
struct BinaryTrees {
    Topology topology;
    Buffer<Aabb> tree_bounds; ///< One box per tree.
    Buffer<Aabb> volumes;     ///< As from aabb_volumes.
    Buffer<Obb> boxes;        ///< As from obb_volumes; empty without oriented boxes.
};

/// The box of the primitives of each tree, one per range of `offsets`.
Buffer<Aabb> bounds_of_trees(Device& device, BufferView<const Aabb> boxes, BufferView<const std::uint32_t> offsets);

} // namespace boxwood
