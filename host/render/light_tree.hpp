// SPDX-License-Identifier: MIT
// The tree by which paths choose a light for a place (cl/render/light_tree.h).
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "shared/light.h"

namespace boxwood {

/// Where a light is, which way it shines and how much.
struct LightBounds {
    glm::dvec3 low{0.0}, high{0.0}; ///< Box in world space. Not of distant lights.
    glm::dvec3 axis{0.0, 0.0, 1.0}; ///< Unit vector: it shines within `spread` of it, and from there on as the cosine.
    double spread = 0.0;            ///< In [0, pi].
    double strength = 0.0;          ///< >= 0: per steradian along the axis; of a distant light irradiance.
    bool distant = false;           ///< Directional: the same everywhere.
};

/// The tree over n > 0 lights (Conty Estevez and Kulla 2018): n - 1 nodes of two children, the root first, then the
/// leaves in the order of the lights. Where some are distant and some not, the root's first child holds those, its
/// second one the others. Split where strength times size times spread of both sides is least, by bins; no path is
/// longer than 64 and the logarithm of n. In double. O(n log n).
std::vector<LightNode> light_tree(const std::vector<LightBounds>& lights);

/// Of a light without extent.
LightBounds punctual_bounds(const LightRecord& record);

} // namespace boxwood
