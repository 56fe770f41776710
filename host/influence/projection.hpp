// SPDX-License-Identifier: MIT
// Boxes as the rays of an area see them, in double precision, for analysis.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include <glm/glm.hpp>

#include "shared/influence.h"

namespace boxwood {

/// A convex polygon, counterclockwise.
struct Polygon {
    /// Cut boxes have outlines of at most 10 corners, 14 within a rectangle, and two of them have at most 28 in common.
    static constexpr std::size_t most = 48;
    std::array<glm::dvec2, most> points;
    std::size_t size = 0;

    /// Never beyond `most`, though rounding may bend an edge and so cut it more than twice.
    void add(const glm::dvec2& point) {
        if (size < most) points[size++] = point;
    }
    double area() const;
};

/// The projection of a parallelepiped (bit k of a corner's index: which end of axis k) on the plane of the rectangle
/// that the rays of `area` leave, which is [-1, 1]^2: of what is not before it.
Polygon projection(const InfluenceRecord& area, std::span<const glm::dvec3, 8> corners);

/// The part of `polygon` within [-1, 1]^2.
Polygon clip_to_rectangle(const Polygon& polygon);

/// What two polygons have in common.
Polygon intersection(const Polygon& a, const Polygon& b);

} // namespace boxwood
