// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "boxwood/scene.hpp"
#include "shared/aabb.h"

namespace boxwood::test {

/// How far from its triangle a ray may be said to hit it, in parts of longest_extent(): 32 roundoffs, above the 18 of
/// cl/bounds/triangle_box.h.
inline constexpr double hit_slack = 0x1p-19;

inline double longest_extent(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const glm::dvec3 size = glm::dvec3(glm::max(glm::max(a, b), c)) - glm::dvec3(glm::min(glm::min(a, b), c));
    return std::max({size.x, size.y, size.z});
}

/// A box around all points at which a ray may be said to hit the triangle.
inline Aabb box_of(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const double slack = hit_slack * longest_extent(a, b, c);
    Aabb box;
    for (int k = 0; k < 3; ++k) {
        const auto outward = [&](double end, float limit) {
            return slack > 0.0 ? std::nextafter(static_cast<float>(end), limit) : static_cast<float>(end);
        };
        box.min[k] = outward(std::min({a[k], b[k], c[k]}) - slack, -std::numeric_limits<float>::infinity());
        box.max[k] = outward(std::max({a[k], b[k], c[k]}) + slack, std::numeric_limits<float>::infinity());
    }
    return box;
}

inline Aabb box_of(const Mesh& mesh, const glm::uvec3& triangle) {
    return box_of(mesh.positions[triangle.x], mesh.positions[triangle.y], mesh.positions[triangle.z]);
}

} // namespace boxwood::test
