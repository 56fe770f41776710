// SPDX-License-Identifier: MIT
// The part of the sample scene about what surfaces look like.
#pragma once

#include "boxwood/scene.hpp"

namespace boxwood::test {

/// Adds materials, textures, pictures and lights with no value at its default, and every attribute to the second mesh.
void add_materials(Scene& scene);

/// Equality of all materials, textures, pictures and lights.
bool same_materials(const Scene& a, const Scene& b);

} // namespace boxwood::test
