// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "io/gltf_mesh.hpp"
#include "io/gltf_nodes.hpp"

namespace boxwood {

/// The camera of a node that has one, named after the node, else after itself. A camera that cannot see (singular
/// placement, no angle or height) gives a warning and none. Throws InputError for an index out of range.
std::optional<Camera> load_camera(const GltfDocument& document, const PlacedNode& placed, Warnings& warnings);

} // namespace boxwood
