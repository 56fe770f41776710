// SPDX-License-Identifier: MIT
// Trees with influence areas of every kind, and what they answer.
#pragma once

#include <limits>
#include <vector>

#include "boxwood/build.hpp"
#include "traverse/scenes.hpp"

namespace boxwood::test {

Ray ray_of(const glm::dvec3& origin, const glm::dvec3& direction, float t_max = std::numeric_limits<float>::infinity());

/// One level, by the default builder.
TreeImage built(const Scene& scene, Layout layout, const std::vector<InfluenceArea>& areas,
                AreaIndexKind index = AreaIndexKind::automatic, BuildReport* report = nullptr);

struct Searches {
    std::size_t local = 0;     ///< Rays that a local tree answered.
    std::size_t continued = 0; ///< Rays that went on to the global one.
};

/// Both layouts and every index; `expected` by brute force or from the tree without areas.
Searches check_areas(const Scene& scene, const std::vector<InfluenceArea>& areas, const std::vector<Ray>& rays,
                     const std::vector<Hit>& expected);

/// `count`, or few under a slow checker.
std::uint32_t ray_count(std::uint32_t count);

} // namespace boxwood::test
