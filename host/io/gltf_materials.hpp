// SPDX-License-Identifier: MIT
#pragma once

#include "io/gltf_mesh.hpp"

namespace boxwood {

/// Puts the file's materials, textures and images into `scene`, in file order. A picture that is missing, unreadable,
/// or neither PNG nor JPEG is left out with a warning, and with it the textures that show it and the inputs that read
/// those: their factors alone count. A number out of its range takes the nearest in it, with a warning. Throws
/// InputError for an index out of range.
void load_materials(const GltfDocument& document, Scene& scene, Warnings& warnings);

} // namespace boxwood
