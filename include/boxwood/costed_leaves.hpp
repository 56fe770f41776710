// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "boxwood/buffer.hpp"
#include "boxwood/topology.hpp"
#include "shared/aabb.h"
#include "shared/influence.h"

namespace boxwood {

/// The leaves at which a tree costs least: n marks by inner node, 1 where the subtree costs no more as one leaf than
/// split further at its best. The first mark on the way down from a root is a leaf; marks below it do not count. A leaf
/// costs `primitive_cost` for each primitive below when its box is met, an inner node twice `box_cost` (both above 0),
/// by the probability that a ray of the tree meets the box. `volumes` as from aabb_volumes, `tree_bounds` by tree; the
/// rays of tree t follow areas[area_starts[t], area_starts[t + 1]) by their shares, the others are isotropic (trees + 1
/// starts). One launch, O(n).
Buffer<std::uint32_t> costed_leaves(Device& device, const Topology& topology, BufferView<const Aabb> volumes,
                                    BufferView<const Aabb> tree_bounds, BufferView<const InfluenceRecord> areas,
                                    BufferView<const std::uint32_t> area_starts, float box_cost = 1.0f,
                                    float primitive_cost = 1.2f);

} // namespace boxwood
