// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "io/gltf_mesh.hpp"

namespace boxwood {

/// Accessors of POSITION, NORMAL, TANGENT, TEXCOORD_0, TEXCOORD_1 and COLOR_0, -1 for none: what makes a primitive's
/// vertices.
using VertexKey = std::array<int, 6>;

VertexKey vertex_key(const tinygltf::Primitive& primitive);

/// Puts the attributes of the vertices from `first` on, whose positions are the last of the mesh, beside them. What an
/// attribute lacks before `first` is filled in. Normals and tangents are normalised; what is not finite, or of texture
/// coordinates beyond largest_coordinate, is replaced (directions by zero, coordinates by 0, colours by white), and a
/// warning counts it. `where` names the attributes. Throws InputError as the accessors do, and for an accessor of
/// another length.
void add_attributes(const GltfDocument& document, const VertexKey& key, std::size_t first, const std::string& where,
                    Mesh& mesh, Warnings& warnings);

/// Fills in what an attribute that the mesh has lacks behind its last vertex.
void complete_attributes(Mesh& mesh);

} // namespace boxwood
