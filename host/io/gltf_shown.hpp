// SPDX-License-Identifier: MIT
// Which meshes the nodes of a file show, and where.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/glm.hpp>

#include "io/gltf_mesh.hpp"
#include "io/gltf_nodes.hpp"

namespace boxwood {

/// A mesh as one node, or one instance of its EXT_mesh_gpu_instancing, shows it.
struct ShownMesh {
    std::size_t node;    ///< Index into the file's nodes.
    glm::dmat4 to_world; ///< Without effect on a skinned mesh.
};

/// In the order of `nodes`. A skinned node's instances would all be the same, so that it shows one, with a warning.
/// Meshes exist. Throws InputError for attributes of instances that differ in count, are none, or cannot be read.
/// O(nodes + instances).
std::vector<ShownMesh> shown_meshes(const GltfDocument& document, const std::vector<PlacedNode>& nodes,
                                    Warnings& warnings);

} // namespace boxwood
