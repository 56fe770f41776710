// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "io/gltf_document.hpp"
#include "io/gltf_warnings.hpp"

namespace boxwood {

struct Pose;

/// The triangle primitives of meshes[index] in a pose, concatenated; primitives that share all accessors of vertices
/// share the vertices. Triangles that use a vertex that is not finite or out of range are dropped and counted, with a
/// warning; points and lines are skipped and counted. The mesh has no triangle when the file has none for it. Throws
/// InputError when a reference or an index is out of range, or when every triangle had to be dropped in a pose that
/// places nothing.
Mesh load_mesh(const GltfDocument& document, std::size_t index, const Pose& pose, ImportCounts& counts,
               Warnings& warnings);

} // namespace boxwood
