// SPDX-License-Identifier: MIT
#include "influence/projection.hpp"

#include <algorithm>

namespace boxwood {

namespace {

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

/// Points of a box cut by a plane: at most 7 corners beside it, and 6 where edges meet it.
struct Points {
    std::array<glm::dvec2, 14> points;
    std::size_t size = 0;
};

/// Coordinates in the frame of an area, x and y over the half sizes of the rectangle that rays leave.
glm::dvec3 in_frame(const InfluenceRecord& area, const glm::dvec3& point) {
    const auto along = [&](const float* axis) {
        double sum = 0.0;
        for (int k = 0; k < 3; ++k) sum += (point[k] - area.origin[k]) * axis[k];
        return sum;
    };
    return {along(area.right) / area.half_width, along(area.up) / area.half_height, along(area.forward)};
}

glm::dvec2 project(const InfluenceRecord& area, const glm::dvec3& p) {
    return area.point ? glm::dvec2(p.x / p.z, p.y / p.z) : glm::dvec2(p.x, p.y);
}

/// The convex hull (Andrew's monotone chain).
Polygon hull(Points& points) {
    const auto begin = points.points.begin(), end = begin + static_cast<std::ptrdiff_t>(points.size);
    std::sort(begin, end, [](const auto& a, const auto& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
    Polygon polygon;
    if (points.size < 3) return polygon;
    const auto add_chain = [&](const auto& point, std::size_t first) {
        while (polygon.size >= first + 2 && cross(polygon.points[polygon.size - 1] - polygon.points[polygon.size - 2],
                                                  point - polygon.points[polygon.size - 1]) <= 0.0)
            --polygon.size;
        polygon.add(point);
    };
    for (auto i = begin; i != end; ++i) add_chain(*i, 0);
    const std::size_t upper = polygon.size - 1;
    for (auto i = end - 1; i != begin;) add_chain(*--i, upper);
    --polygon.size; // the first point again
    return polygon;
}

/// The part where inside(point) >= 0, linear in the point.
template <class Inside>
Polygon clip(const Polygon& polygon, const Inside& inside) {
    Polygon result;
    for (std::size_t i = 0; i < polygon.size; ++i) {
        const glm::dvec2 &a = polygon.points[i], &b = polygon.points[(i + 1) % polygon.size];
        const double at_a = inside(a), at_b = inside(b);
        if (at_a >= 0.0) result.add(a);
        if ((at_a >= 0.0) != (at_b >= 0.0)) result.add(a + (b - a) * (at_a / (at_a - at_b)));
    }
    return result;
}

} // namespace

double Polygon::area() const {
    double twice = 0.0;
    for (std::size_t i = 2; i < size; ++i) twice += cross(points[i - 1] - points[0], points[i] - points[0]);
    return std::max(0.0, 0.5 * twice);
}

Polygon projection(const InfluenceRecord& area, std::span<const glm::dvec3, 8> corners) {
    // The eye sees nothing at no distance, where regions may begin.
    const double near = area.point ? std::max<double>(area.near, area.far * 0x1p-20) : area.near;
    std::array<glm::dvec3, 8> local;
    Points points;
    for (std::size_t i = 0; i < 8; ++i) {
        local[i] = in_frame(area, corners[i]);
        if (local[i].z >= near) points.points[points.size++] = project(area, local[i]);
    }
    if (points.size == 8 || points.size == 0) return points.size == 0 ? Polygon{} : hull(points);
    for (std::size_t from = 0; from < 8; ++from) {
        for (std::size_t axis = 1; axis < 8; axis *= 2) {
            const std::size_t to = from | axis;
            if (from & axis || (local[from].z >= near) == (local[to].z >= near)) continue;
            const double t = (near - local[from].z) / (local[to].z - local[from].z);
            glm::dvec3 cut = local[from] + (local[to] - local[from]) * t;
            cut.z = near;
            points.points[points.size++] = project(area, cut);
        }
    }
    return hull(points);
}

Polygon clip_to_rectangle(const Polygon& polygon) {
    Polygon result = clip(polygon, [](const glm::dvec2& p) { return p.x + 1.0; });
    result = clip(result, [](const glm::dvec2& p) { return 1.0 - p.x; });
    result = clip(result, [](const glm::dvec2& p) { return p.y + 1.0; });
    return clip(result, [](const glm::dvec2& p) { return 1.0 - p.y; });
}

Polygon intersection(const Polygon& a, const Polygon& b) {
    if (b.size < 3) return {};
    Polygon result = a;
    for (std::size_t i = 0; i < b.size && result.size > 2; ++i) {
        const glm::dvec2 from = b.points[i], edge = b.points[(i + 1) % b.size] - from;
        result = clip(result, [&](const glm::dvec2& p) { return cross(edge, p - from); });
    }
    return result;
}

} // namespace boxwood
