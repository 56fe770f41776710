// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "boxwood/scene.hpp"

namespace boxwood {

/// Writes `scene` as save_glb does, but as line geometry (glTF mode 1): the vertex numbers in Mesh::triangles, taken
/// one after another, are the two ends of each line. Each mesh has an even number of triangles.
void save_glb_lines(const std::filesystem::path& file, const Scene& scene);

} // namespace boxwood
