// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "io/gltf_mesh.hpp"
#include "io/gltf_nodes.hpp"

namespace boxwood {

/// The light of KHR_lights_punctual of a node that has one, named after the node, else after itself; it shines along
/// the node's -z. One that gives no light (an intensity or a colour of zero, or negative, or beyond float) or stands
/// nowhere gives a warning and none; an angle, a colour or a range out of its range takes the nearest in it, with a
/// warning. Throws InputError for an index out of range.
std::optional<Light> load_light(const GltfDocument& document, const PlacedNode& placed, Warnings& warnings);

} // namespace boxwood
