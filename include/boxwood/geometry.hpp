// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "boxwood/buffer.hpp"
#include "boxwood/scene.hpp"
#include "shared/instance.h"

namespace boxwood {

/// A scene's triangles on a device, all meshes concatenated.
struct Geometry {
    Buffer<float> positions;         ///< 3 per vertex, object space.
    Buffer<std::uint32_t> triangles; ///< 3 per triangle: indices into the concatenated vertices.
    Buffer<MeshRange> meshes;
    Buffer<InstanceRecord> instances; ///< Same order as Scene::instances; `root` is the tree builder's, here 0.
    bool transforms = true;           ///< False where every instance has its mesh where the vertices are.

    std::size_t vertex_count() const { return positions.size() / 3; }
    std::size_t triangle_count() const { return triangles.size() / 3; }
};

/// The records of a scene's instances, inverses computed in double and rounded once. Throws InputError for a mesh
/// index out of range.
std::vector<InstanceRecord> instance_records(const Scene& scene);

/// Uploads a valid scene. Throws CapacityError, before anything is uploaded, when it does not fit.
Geometry upload(Device& device, const Scene& scene);

} // namespace boxwood
