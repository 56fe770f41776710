// SPDX-License-Identifier: MIT
// The lights of a scene as shading reads them, and the tree by which they are chosen.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "boxwood/requirements.hpp"
#include "shared/light.h"

namespace boxwood {

/// Records and, unless there are none, the tree over them (see Appearance).
struct LightList {
    std::vector<LightRecord> records;
    std::vector<LightNode> nodes;
};

/// The most lights that light_list() can make. O(size of the scene).
std::uint64_t light_limit(const Scene& scene, const ShadingRequirements& requirements);

/// `emission` has the mean radiance of each material, textures included, the plain one last. A triangle is left out
/// when that is zero, or when its area in world space is zero. O(n log n) in the lights. In double.
LightList light_list(const Scene& scene, const ShadingRequirements& requirements,
                     const std::vector<glm::dvec3>& emission);

} // namespace boxwood
