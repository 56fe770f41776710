// SPDX-License-Identifier: MIT
// The meshes of a scene that the meshes of a file become: one as it is, one for each choice of morph weights, one for
// each node that skins or flattens it.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "io/gltf_shown.hpp"

namespace boxwood {

/// A mesh of the file in one form.
struct MeshForm {
    std::size_t mesh; ///< Index into the file's meshes.
    std::size_t node; ///< A node that shows it with the form's morph weights.
    /// The shown mesh whose joints or transform put the vertices into world space, an index; none: instances place the
    /// form.
    std::optional<std::size_t> placed_by;
};

struct MeshForms {
    std::vector<MeshForm>
        forms; ///< Those that instances place in the order of meshes, then the others as they are shown.
    std::vector<std::size_t> of_shown; ///< By shown mesh, an index into `forms`.
};

/// Weights of the morph targets of a node's mesh: its own, else those of the mesh.
const std::vector<double>& morph_weights(const GltfDocument& document, std::size_t node);

/// Shown meshes of one mesh and equal weights share a form, unless it is skinned, or flattened: transforms of instances
/// need an inverse in float, so a transform that has none, but leaves a plane, is put into the vertices. Throws
/// InputError where forms but the first of each mesh would take more than 4 GiB, or poses as much to read. O(shown +
/// primitives).
MeshForms mesh_forms(const GltfDocument& document, const std::vector<ShownMesh>& shown);

} // namespace boxwood
