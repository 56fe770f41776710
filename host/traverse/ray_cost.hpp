// SPDX-License-Identifier: MIT
#pragma once

#include "boxwood/topology.hpp"
#include "shared/aabb.h"
#include "shared/ray.h"
#include "shared/scene_sphere.h"
#include "shared/triangle.h"
#include "shared/visits.h"

namespace boxwood {

/// One tree over triangles as its builder left it, before any layout.
struct MarkedTree {
    const Topology& topology;
    BufferView<const Aabb> volumes;         ///< As from aabb_volumes.
    BufferView<const std::uint32_t> leaves; ///< As in TopDownTree.
    BufferView<const Triangle> triangles;   ///< By sorted position.
    SceneSphere sphere;                     ///< Around all triangles, see scene_sphere.
};

/// Follows each ray twice: through every box that it meets on its whole way (paper 9.1), and in search of its closest
/// hit, nearest child first and never beyond the best hit so far. `visits` and `hits` have an element per ray. Boxes
/// are met as in closest_hit, with its slack for roundings. Waits for the tree's height. Throws CapacityError for a
/// tree too deep to trace.
void ray_visits(Device& device, const MarkedTree& tree, BufferView<const Ray> rays, BufferView<RayVisits> visits,
                BufferView<Hit> hits);

} // namespace boxwood
