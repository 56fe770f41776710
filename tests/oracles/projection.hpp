// SPDX-License-Identifier: MIT
// The projection of a box along the rays of an influence area, in double precision: polygons cut by half planes and
// hulls.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "shared/aabb.h"
#include "shared/influence.h"

namespace boxwood::test {

using Polygon = std::vector<glm::dvec2>;

/// The record's frame made orthonormal in double precision, from forward: rows right, up, forward.
glm::dmat3 exact_frame(const InfluenceRecord& area);
/// right, up, forward coordinates of a point.
glm::dvec3 area_coordinates(const InfluenceRecord& area, const glm::dvec3& point);

Polygon hull_of(Polygon points);
double area_of(const Polygon& polygon);
/// What of a convex polygon lies where dot(normal, p) <= limit.
Polygon cut(const Polygon& polygon, const glm::dvec2& normal, double limit);

/// The projection, in units of the rectangle's half extents, of what of the box has a depth of at least `near`.
Polygon projection(const InfluenceRecord& area, const Aabb& box, double near);
/// Its area over the rectangle's.
double reference_probability(const InfluenceRecord& area, const Aabb& box, bool culled, double near);

/// The record of an area with a forward direction that need not be normalised.
InfluenceRecord make_area(bool point, const glm::dvec3& origin, const glm::dvec3& forward, double half_width,
                          double half_height, double near, double far);

} // namespace boxwood::test
