// SPDX-License-Identifier: MIT
// Rays against triangles in 113-bit arithmetic, where nothing of what floats say is rounded for coordinates within some 2^16 of each
// other.
#pragma once

#include <array>
#include <span>

#include "boxwood/scene.hpp"
#include "shared/ray.h"

namespace boxwood::test {

using Corners = std::array<glm::vec3, 3>;

/// Whether the ray's line meets the triangle, edges and corners included, and the parameter where it meets its plane; 0 where it is
/// parallel to that.
struct ExactIntersection {
    bool inside = false;
    __float128 t = 0;
};
ExactIntersection exact_intersection(const Ray& ray, const Corners& corners);

/// The closest hit beyond t_min up to t_max; t is negative where there is none.
struct ExactHit {
    __float128 t = -1;
    std::size_t triangle = 0;
};
ExactHit exact_hit(const Ray& ray, std::span<const Corners> triangles);

} // namespace boxwood::test
