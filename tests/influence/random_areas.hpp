// SPDX-License-Identifier: MIT
// Influence areas of all orientations, and boxes in and about them.
#pragma once

#include <cmath>

#include "oracles/projection.hpp"
#include "support.hpp"

namespace boxwood::test {

inline glm::dvec3 random_vector(Random& random, double scale) {
    return scale * glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
}

/// Directions along axes, in their planes and oblique.
inline glm::dvec3 random_direction(Random& random) {
    glm::dvec3 v = random_vector(random, 1);
    const std::uint32_t kind = random.below(4);
    const std::uint32_t k = random.below(3);
    if (kind == 0) v[k] = v[(k + 1) % 3] = 0;
    if (kind == 1) v[k] = 0;
    return glm::length(v) > 0.01 ? v : glm::dvec3(1, 0, 0);
}

inline InfluenceRecord random_area(Random& random, bool point, double scale) {
    const double near = point ? scale * random.uniform(0.05f, 0.5f) : 0;
    const double size = point ? 1.0 : scale;
    return make_area(point, random_vector(random, scale), random_direction(random), size * random.uniform(0.2f, 1.5f),
                     size * random.uniform(0.2f, 1.5f), near, 10 * scale);
}

/// A point of the region or a little beside it.
inline glm::dvec3 random_place(Random& random, const InfluenceRecord& area, double scale) {
    const double depth = area.near + scale * random.uniform(-0.3f, 4);
    const double unit = area.point != 0 ? std::abs(depth) : 1;
    const glm::dvec3 p(1.2 * random.uniform(-1, 1) * area.half_width * unit,
                       1.2 * random.uniform(-1, 1) * area.half_height * unit, depth);
    return glm::dvec3(area.origin[0], area.origin[1], area.origin[2]) + glm::transpose(exact_frame(area)) * p;
}

/// A box of random size about a point, also flat, a line or a point.
inline Aabb random_box(Random& random, double scale, const glm::dvec3& centre) {
    glm::dvec3 half = glm::abs(random_vector(random, scale)) * std::exp2(-double(random.uniform(-1, 8)));
    for (int k = 0; k < 3; ++k)
        if (random.below(12) == 0) half[k] = 0;
    Aabb box;
    for (int k = 0; k < 3; ++k) {
        box.min[k] = static_cast<float>(centre[k] - half[k]);
        box.max[k] = static_cast<float>(centre[k] + half[k]);
    }
    return box;
}

} // namespace boxwood::test
