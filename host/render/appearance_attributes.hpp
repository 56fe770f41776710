// SPDX-License-Identifier: MIT
// Attributes of vertices as shading reads them (cl/render/scene_arrays.h).
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "boxwood/requirements.hpp"

namespace boxwood {

/// Tangents for the triangles of a mesh whose materials have a normal texture, from its texture coordinates: per vertex
/// the sum of its triangles' directions of growing u, weighted by area, made perpendicular to the normal and
/// normalised; w is the side on which v grows. Zero where there is no direction: no such triangle, no area, in space or
/// in texture. Vertices are not split, so that a vertex where a texture is mirrored has what its larger side says. In
/// double. O(vertices + triangles).
std::vector<glm::vec4> make_tangents(const Scene& scene, const Mesh& mesh);

/// requirements.attribute_floats() per vertex of all meshes: zero for what a mesh lacks, white for colours. Tangents
/// that are lacking or zero are made, of meshes in use that need them. O(size of the scene).
std::vector<float> vertex_attributes(const Scene& scene, const ShadingRequirements& requirements);

} // namespace boxwood
