// SPDX-License-Identifier: MIT
// The regions of influence areas on the host.
#include <algorithm>
#include <cmath>
#include <limits>

#include "boxwood/influence.hpp"

namespace boxwood {

namespace {

glm::dvec3 vector(const float* v) { return {v[0], v[1], v[2]}; }

/// Rows right, up, forward: orthonormal but for the rounding of the record.
glm::dmat3 frame_of(const InfluenceRecord& area) {
    return glm::transpose(glm::dmat3(vector(area.right), vector(area.up), vector(area.forward)));
}

/// The corners less the origin, in order of `corners`.
std::array<glm::dvec3, 8> local_corners(const InfluenceRecord& area) {
    const glm::dmat3 world = glm::inverse(frame_of(area));
    std::array<glm::dvec3, 8> corners;
    for (std::size_t i = 0; i < 8; ++i) {
        const double depth = i < 4 ? area.near : area.far;
        const double unit = area.point != 0 ? depth : 1;
        corners[i] = world * glm::dvec3((i & 1 ? 1 : -1) * unit * area.half_width,
                                        (i & 2 ? 1 : -1) * unit * area.half_height, depth);
    }
    return corners;
}

/// Whether the points and the box [low, high] lie on different sides of a plane across `axis`, which need not be
/// normalised, by more than rounding may be wrong.
bool apart(const glm::dvec3& axis, const std::array<glm::dvec3, 8>& points, const glm::dvec3& low,
           const glm::dvec3& high) {
    double box_low = 0, box_high = 0, size = 0;
    for (int k = 0; k < 3; ++k) {
        box_low += std::min(axis[k] * low[k], axis[k] * high[k]);
        box_high += std::max(axis[k] * low[k], axis[k] * high[k]);
        size += std::abs(axis[k]) * std::max(std::abs(low[k]), std::abs(high[k]));
    }
    double least = std::numeric_limits<double>::infinity(), most = -least, reach = 0;
    for (const glm::dvec3& p : points) {
        const double at = glm::dot(axis, p);
        least = std::min(least, at);
        most = std::max(most, at);
        reach = std::max(reach, glm::dot(glm::abs(axis), glm::abs(p)));
    }
    const double rounding = 16 * std::numeric_limits<double>::epsilon() * (size + reach);
    return least - box_high > rounding || box_low - most > rounding;
}

} // namespace

std::array<glm::dvec3, 8> corners(const InfluenceRecord& area) {
    std::array<glm::dvec3, 8> corners = local_corners(area);
    for (glm::dvec3& corner : corners) corner += vector(area.origin);
    return corners;
}

bool contains(const InfluenceRecord& area, const glm::dvec3& point) {
    const glm::dvec3 p = frame_of(area) * (point - vector(area.origin));
    const double unit = area.point != 0 ? p.z : 1;
    return p.z >= area.near && p.z <= area.far && std::abs(p.x) <= unit * area.half_width &&
           std::abs(p.y) <= unit * area.half_height;
}

bool encloses(const InfluenceRecord& area, const Aabb& box) {
    for (int i = 0; i < 8; ++i) {
        glm::dvec3 corner;
        for (int k = 0; k < 3; ++k) corner[k] = (i >> k & 1 ? box.max : box.min)[k];
        if (!contains(area, corner)) return false; // also where it is empty
    }
    return true;
}

bool intersects(const InfluenceRecord& area, const Aabb& box) {
    for (int k = 0; k < 3; ++k)
        if (!(box.min[k] <= box.max[k])) return false;
    const std::array<glm::dvec3, 8> points = local_corners(area);
    const glm::dvec3 low = vector(box.min) - vector(area.origin), high = vector(box.max) - vector(area.origin);
    const glm::dvec3 right = vector(area.right), up = vector(area.up), forward = vector(area.forward);

    std::vector<glm::dvec3> normals{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, forward};
    // Of the far face: the near one of a region from the eye on is a point.
    std::vector<glm::dvec3> edges{points[5] - points[4], points[6] - points[4]};
    if (area.point == 0) {
        normals.insert(normals.end(), {right, up});
        edges.push_back(points[4] - points[0]);
    } else {
        const double width = area.half_width, height = area.half_height;
        normals.insert(normals.end(), {right - width * forward, right + width * forward, up - height * forward,
                                       up + height * forward});
        for (std::size_t i = 0; i < 4; ++i) edges.push_back(points[i + 4] - points[i]);
    }
    for (const glm::dvec3& normal : normals)
        if (apart(normal, points, low, high)) return false;
    for (const glm::dvec3& edge : edges)
        for (int k = 0; k < 3; ++k) {
            glm::dvec3 axis(0);
            axis[k] = 1;
            if (apart(glm::cross(axis, edge), points, low, high)) return false;
        }
    return true;
}

Aabb enclosing_box(const InfluenceRecord& area) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    Aabb box = {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    for (const glm::dvec3& local : local_corners(area)) {
        // A few roundings of the largest term, which the origin may cancel, and one to float.
        const double reach = std::abs(local.x) + std::abs(local.y) + std::abs(local.z);
        for (int k = 0; k < 3; ++k) {
            const double at = area.origin[k] + local[k];
            const double rounding = 16 * std::numeric_limits<double>::epsilon() * (std::abs(area.origin[k]) + reach);
            box.min[k] = std::min(box.min[k], std::nextafter(static_cast<float>(at - rounding), -infinity));
            box.max[k] = std::max(box.max[k], std::nextafter(static_cast<float>(at + rounding), infinity));
        }
    }
    return box;
}

} // namespace boxwood
