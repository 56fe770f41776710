// SPDX-License-Identifier: MIT
// The influence areas that a set of lines suggests: of those through one point, and of parallel ones.
#pragma once

#include <vector>

#include "boxwood/influence.hpp"
#include "scene/world_box.hpp"
#include "shared/ray.h"

namespace boxwood {

/// A ray up to its end: where it hits or its interval ends.
struct Line {
    Ray ray;
    glm::dvec3 from, to, direction; ///< direction normalised
};

/// The lines of valid rays that hit something or have an end, in their order. O(rays).
std::vector<Line> lines_of(const std::vector<Ray>& rays, const std::vector<Hit>& hits);

/// Lines that share an area.
struct LineArea {
    InfluenceArea area; ///< Valid (see validate); no share.
    std::vector<Line> lines;
};

/// Fewer lines than these suggest nothing.
inline constexpr std::size_t least_lines = 16;

/// Lines through one point, to within 2^-10 of the scene's diagonal, make one point area (none where they leave it
/// beyond 80 degrees); of others each direction that least_lines or more share, to within half a degree, makes a plane
/// area over them. Both reach through `scene`, and a 16th farther to the sides than the lines do. An area beyond what
/// coordinates may be is left out. O(lines^2) at most.
std::vector<LineArea> areas_of_lines(std::vector<Line> lines, const DoubleBox& scene);

} // namespace boxwood
