// SPDX-License-Identifier: MIT
#pragma once

#include "shared/triangle.h"
#include "volumes/binary_trees.hpp"

namespace boxwood {

/// Triangles that end_point_overlap takes at most, and nodes that they visit about at most.
inline constexpr std::uint32_t overlap_samples = 65536;
inline constexpr std::uint64_t overlap_visits = std::uint64_t{1} << 28;

/// The end-point overlap of trees over triangles (Aila, Karras and Laine 2013, "On quality metrics of bounding volume
/// hierarchies"), every node at cost 1: the sum over nodes of the area of the triangles that are not below the node but
/// inside its box, over the area of all triangles. It is the number of nodes that a ray tests needlessly because it
/// ends there. A node counts where a ray reaches it: where all its ancestors meet the triangle, which matters only for
/// oriented boxes, as these do not nest. Trees count by their triangles' area, each in its own space.
///
/// `triangles` by sorted position, as from collapse_binary. Of more than overlap_samples triangles that many are taken,
/// evenly spaced in sorted order, and stand for all; fewer (a power of four times 256) where they would visit more than
/// overlap_visits nodes. 0 when the triangles have no area. Waits. O(samples nodes met).
double end_point_overlap(Device& device, const BinaryTrees& trees, BufferView<const Triangle> triangles);

} // namespace boxwood
