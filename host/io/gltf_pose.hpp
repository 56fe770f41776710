// SPDX-License-Identifier: MIT
// The shape in which a node shows its mesh at rest.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "io/gltf_document.hpp"

namespace boxwood {

class Warnings;

/// What a node makes of the vertices of its mesh, in this order (glTF 2.0 sections 3.7.2.2 and 3.7.3.3): morph targets
/// are added, and joints move them to world space. By default nothing, so that an instance's transform can place the
/// mesh.
struct Pose {
    std::vector<double> weights; ///< Of the morph targets in their order; 0 for those beyond.
    /// By joint of the skin: from the mesh to world space. Empty: not skinned.
    std::vector<glm::dmat4> joints;
    /// From the mesh to world space, for the vertices of primitives without joints. None: they stay in the mesh's own
    /// space.
    std::optional<glm::dmat4> placement;

    /// Whether the mesh comes out in world space.
    bool places() const { return !joints.empty() || placement.has_value(); }
    bool empty() const { return weights.empty() && !places(); }
};

/// The accessors that the pose of a primitive's vertices reads, in a fixed order: primitives that share them, and those
/// of VertexKey, share vertices. `where` names the primitive. Throws InputError for joints without weights or the
/// reverse.
std::vector<int> pose_accessors(const GltfDocument& document, const tinygltf::Primitive& primitive, const Pose& pose,
                                const std::string& where);

/// Poses the vertices from `first` on, the last of the mesh, with the normals and tangents that they have; in double,
/// rounded once. Where space is flattened, normals become zero (none). Positions may come out that are not finite or
/// out of range. Returns for each of these vertices whether its surroundings are mirrored; tangents take that into
/// their w. Weights of a vertex are divided by their sum. Weights that are negative or not finite count as 0, vertices
/// without weight follow their first joint, with a warning, as for weights whose sum is far off 1. Throws InputError as
/// the accessors do, for one of another length, and for a joint that the skin does not have. O(vertices * (morph
/// targets with a weight + joints of a vertex)).
std::vector<bool> pose_vertices(const GltfDocument& document, const tinygltf::Primitive& primitive, const Pose& pose,
                                const std::string& where, std::size_t first, Mesh& mesh, Warnings& warnings);

/// From the mesh's to world space for each joint of skins[index]: the joint's global transform times its inverse bind
/// matrix, in double. `globals` are those of all nodes. Throws InputError for a skin or a joint that does not exist,
/// for a skin without joints, and for fewer matrices than joints. The last row of a matrix counts as 0 0 0 1, with a
/// warning where it is another. O(joints).
std::vector<glm::dmat4> joint_matrices(const GltfDocument& document, int index, const std::string& node,
                                       const std::vector<glm::dmat4>& globals, Warnings& warnings);

} // namespace boxwood
