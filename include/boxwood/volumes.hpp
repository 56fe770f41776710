// SPDX-License-Identifier: MIT
#pragma once

#include "boxwood/bounds.hpp"
#include "boxwood/geometry.hpp"
#include "boxwood/topology.hpp"
#include "shared/aabb.h"
#include "shared/obb.h"

namespace boxwood {

/// The axis-aligned box of every node of `topology`, bottom-up in one launch (dissertation 3.3.4): 2n boxes by node
/// index, those of unused slots empty. `boxes` are the primitives' boxes in their own order. Each box is the exact hull
/// of those below it. O(n).
Buffer<Aabb> aabb_volumes(Device& device, const Topology& topology, BufferView<const Aabb> boxes);

/// The oriented box of every node of trees over the triangles of `geometry`: 2n boxes by node index, those of unused
/// slots empty (dissertation 3.5). Kinds that merge children take one launch per level. `aabbs` as from aabb_volumes
/// over the same topology. Every box holds every vertex below it, and every point at which a ray may be said to hit a
/// triangle there: extents are padded by a bound on their rounding and on that of hits. `options.kind` is not aabb.
/// Kinds with exact extents take O(n depth) work, spread evenly over work-items whatever the shape of the tree; the
/// others O(n). Throws CapacityError when it does not fit.
Buffer<Obb> obb_volumes(Device& device, const Topology& topology, BufferView<const Aabb> aabbs,
                        const Geometry& geometry, const BoundsOptions& options);

/// The same for one tree over instances (dissertation 3.6.2), whose primitives are the boxes `mesh_boxes` (by mesh) of
/// their meshes under their transforms, M_i = M_o M_m (3.1.4), which are the leaves' boxes as they are, sheared or not.
/// Boxes are padded by what rays in `sphere`, that of the scene, may be off in object space.
Buffer<Obb> obb_volumes(Device& device, const Topology& topology, BufferView<const Aabb> aabbs,
                        BufferView<const InstanceRecord> instances, BufferView<const Obb> mesh_boxes,
                        const SceneSphere& sphere, const BoundsOptions& options);

} // namespace boxwood
