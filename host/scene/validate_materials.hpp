// SPDX-License-Identifier: MIT
// The part of validate() about what surfaces look like.
#pragma once

#include <string>

#include "boxwood/scene.hpp"

namespace boxwood {

/// Throws InputError unless materials, textures, images and lights keep their promises.
void validate_materials(const Scene& scene, const std::string& file);

/// Likewise for the materials and attributes of one mesh, which `where` names.
void validate_materials(const Scene& scene, const Mesh& mesh, const std::string& file, const std::string& where);

} // namespace boxwood
