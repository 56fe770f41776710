// SPDX-License-Identifier: MIT
// The part of the glTF writer about materials, textures and lights.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "boxwood/scene.hpp"

namespace boxwood {

/// Appends what a valid scene has of "materials", "textures", "samplers", "images", lights and "extensionsUsed" to the
/// members of the root object. `image_views` are the buffer views of the images.
void append_materials(std::string& text, const Scene& scene, const std::vector<std::size_t>& image_views);

/// Matrix of a node that places a light, its -z along the direction.
glm::mat4 placement(const Light& light);

} // namespace boxwood
