// SPDX-License-Identifier: MIT
#pragma once

#include "boxwood/scene.hpp"
#include "shared/aabb.h"

namespace boxwood::test {

inline Aabb box_of(const Mesh& mesh, const glm::uvec3& triangle) {
    const glm::vec3 a = mesh.positions[triangle.x], b = mesh.positions[triangle.y], c = mesh.positions[triangle.z];
    const glm::vec3 low = glm::min(glm::min(a, b), c), high = glm::max(glm::max(a, b), c);
    return {{low.x, low.y, low.z}, {high.x, high.y, high.z}};
}

} // namespace boxwood::test
