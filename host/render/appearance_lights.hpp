// SPDX-License-Identifier: MIT
// The lights of a scene as shading reads them, and how often each is chosen.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "boxwood/requirements.hpp"
#include "shared/light.h"

namespace boxwood {

/// Records and, unless there are none, their distribution (see Appearance).
struct LightList {
    std::vector<LightRecord> records;
    std::vector<float> distribution;
};

/// The most lights that light_list() can make. O(size of the scene).
std::uint64_t light_limit(const Scene& scene, const ShadingRequirements& requirements);

/// `emission` has the mean radiance of each material, textures included, the plain one last. A triangle is left out when that is
/// zero, or when its area in world space is zero. The power of a light is what it gives off (pi times
/// radiance times area, from both sides when double-sided; intensity over all directions), of a directional one what passes
/// through a disc as large as the scene. Where no light has any power all are chosen alike. In double. O(size of the scene).
LightList light_list(const Scene& scene, const ShadingRequirements& requirements,
                     const std::vector<glm::dvec3>& emission);

} // namespace boxwood
