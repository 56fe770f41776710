// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include <glm/glm.hpp>

#include "io/gltf_document.hpp"
#include "io/gltf_warnings.hpp"

namespace boxwood {

/// A node of the loaded scene and where it stands.
struct PlacedNode {
    std::size_t node; ///< Index into the file's nodes.
    glm::dmat4 to_world;
};

/// The nodes of the default scene (else of scene 0, else below every root) depth first, children in file order.
/// Transforms are composed in double. A node that the scene lists twice, or beside a node above it, is there once, with
/// a warning. Throws InputError for an index out of range, a node that is its own ancestor or has two parents, or a
/// matrix that is not affine. O(nodes), without recursion.
std::vector<PlacedNode> place_nodes(const GltfDocument& document, Warnings& warnings);

/// The global transform of every node of the file, in or out of the loaded scene, in double: joints may stand anywhere.
/// Throws as place_nodes. O(nodes).
std::vector<glm::dmat4> global_transforms(const GltfDocument& document);

/// T R S of glTF; `rotation` is a quaternion (x, y, z, w) of any length but zero, for which the result is not finite.
glm::dmat4 compose(glm::dvec3 translation, glm::dvec4 rotation, glm::dvec3 scale);

} // namespace boxwood
