// SPDX-License-Identifier: MIT
#include "oracles/projection.hpp"

#include <algorithm>
#include <cmath>

namespace boxwood::test {

namespace {

glm::dvec3 vector(const float* v) { return {v[0], v[1], v[2]}; }

double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

Polygon culled_polygon(Polygon polygon) {
    for (const glm::dvec2 side : {glm::dvec2(1, 0), glm::dvec2(-1, 0), glm::dvec2(0, 1), glm::dvec2(0, -1)})
        polygon = cut(polygon, side, 1.0);
    return polygon;
}

} // namespace

glm::dmat3 exact_frame(const InfluenceRecord& area) {
    const glm::dvec3 forward = glm::normalize(vector(area.forward));
    glm::dvec3 right = vector(area.right), up = vector(area.up);
    right = glm::normalize(right - forward * glm::dot(forward, right));
    up -= forward * glm::dot(forward, up);
    up = glm::normalize(up - right * glm::dot(right, up));
    return glm::transpose(glm::dmat3(right, up, forward));
}

glm::dvec3 area_coordinates(const InfluenceRecord& area, const glm::dvec3& point) {
    return exact_frame(area) * (point - vector(area.origin));
}

Polygon hull_of(Polygon points) {
    std::sort(points.begin(), points.end(),
              [](const glm::dvec2& a, const glm::dvec2& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
    Polygon hull;
    for (int side = 0; side < 2; ++side) {
        const std::size_t start = hull.size();
        for (const glm::dvec2& p : points) {
            while (hull.size() >= start + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
            hull.push_back(p);
        }
        if (!hull.empty()) hull.pop_back();
        std::reverse(points.begin(), points.end());
    }
    return hull;
}

double area_of(const Polygon& polygon) {
    double sum = 0;
    for (std::size_t i = 2; i < polygon.size(); ++i) sum += turn(polygon[0], polygon[i - 1], polygon[i]);
    return 0.5 * sum;
}

Polygon cut(const Polygon& polygon, const glm::dvec2& normal, double limit) {
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 p = polygon[i], q = polygon[(i + 1) % polygon.size()];
        const double a = glm::dot(normal, p) - limit, b = glm::dot(normal, q) - limit;
        if (a <= 0) kept.push_back(p);
        if ((a <= 0) != (b <= 0)) kept.push_back(p + (q - p) * (a / (a - b)));
    }
    return kept;
}

Polygon projection(const InfluenceRecord& area, const Aabb& box, double near) {
    const glm::dmat3 frame = exact_frame(area);
    const glm::dvec3 origin = vector(area.origin);
    glm::dvec3 corner[8];
    for (int i = 0; i < 8; ++i)
        corner[i] = frame * (glm::dvec3((i & 1 ? box.max : box.min)[0], (i & 2 ? box.max : box.min)[1],
                                        (i & 4 ? box.max : box.min)[2]) -
                             origin);
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 8; ++i)
        for (int j = i; j < 8; ++j) { // all pairs: diagonals add points inside
            const double a = corner[i].z - near, b = corner[j].z - near;
            if (i == j && a >= 0) points.push_back(corner[i]);
            if ((a >= 0) != (b >= 0)) {
                glm::dvec3 p = corner[i] + (corner[j] - corner[i]) * (a / (a - b));
                p.z = near;
                points.push_back(p);
            }
        }
    Polygon projected;
    for (const glm::dvec3& p : points)
        projected.push_back(glm::dvec2(p) / (area.point ? p.z : 1.0) / glm::dvec2(area.half_width, area.half_height));
    return hull_of(projected);
}

double reference_probability(const InfluenceRecord& area, const Aabb& box, bool culled, double near) {
    const Polygon polygon = projection(area, box, near);
    return area_of(culled ? culled_polygon(polygon) : polygon) / 4;
}

InfluenceRecord make_area(bool point, const glm::dvec3& origin, const glm::dvec3& forward, double half_width,
                          double half_height, double near, double far) {
    const glm::dvec3 f = glm::normalize(forward);
    const glm::dvec3 world = std::abs(f.y) < 0.999 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
    const glm::dvec3 right = glm::normalize(glm::cross(f, world)), up = glm::cross(right, f);
    InfluenceRecord area = {};
    for (int k = 0; k < 3; ++k) {
        area.origin[k] = static_cast<float>(origin[k]);
        area.right[k] = static_cast<float>(right[k]);
        area.up[k] = static_cast<float>(up[k]);
        area.forward[k] = static_cast<float>(f[k]);
    }
    area.point = point ? 1 : 0;
    area.half_width = static_cast<float>(half_width);
    area.half_height = static_cast<float>(half_height);
    area.near = static_cast<float>(near);
    area.far = static_cast<float>(far);
    area.sin_tolerance = 0.0087f;
    area.share = 0.5f;
    return area;
}

} // namespace boxwood::test
