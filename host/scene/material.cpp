// SPDX-License-Identifier: MIT
#include "boxwood/material.hpp"

namespace boxwood {

Material plain_material() {
    Material material;
    material.name = "plain";
    material.base_color = {0.8f, 0.8f, 0.8f, 1.0f};
    material.metallic = 0.0f;
    material.specular = 0.0f;
    return material;
}

} // namespace boxwood
