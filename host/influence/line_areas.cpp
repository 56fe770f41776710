// SPDX-License-Identifier: MIT
#include "influence/line_areas.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "influence/area_fault.hpp"

namespace boxwood {

namespace {

/// Rays between those of a probe of 16 x 16 lie beyond the outermost by up to half their distance, a 32nd, and some.
constexpr double margin = 1.0 + 1.0 / 16;
/// Of the scene's diagonal: how far from their common point lines may pass, and the least half extent of an area.
constexpr double small_share = 0x1p-10;

glm::dvec3 vector(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// The point nearest to all lines by least squares, when they meet in it.
std::optional<glm::dvec3> common_point(const std::vector<Line>& lines, double size) {
    glm::dmat3 sum(0.0);
    glm::dvec3 right(0.0);
    const glm::dvec3 middle = lines[0].from;
    for (const Line& line : lines) {
        const glm::dmat3 across = glm::dmat3(1.0) - glm::outerProduct(line.direction, line.direction);
        sum += across;
        right += across * (line.from - middle);
    }
    // Parallel lines have no such point: the determinant is 0 but for their spread.
    const double count = static_cast<double>(lines.size());
    if (!(glm::determinant(sum) > 0x1p-20 * count * count * count)) return std::nullopt;
    const glm::dvec3 point = middle + glm::inverse(sum) * right;
    for (const Line& line : lines)
        if (glm::length(glm::cross(point - line.from, line.direction)) > small_share * size) return std::nullopt;
    return point;
}

/// Coordinates along right, up and forward of an area's record.
glm::dvec3 in_frame(const InfluenceRecord& frame, const glm::dvec3& v) {
    return {glm::dot(v, vector(frame.right)), glm::dot(v, vector(frame.up)), glm::dot(v, vector(frame.forward))};
}

/// The box of points in such coordinates.
template <class Points>
DoubleBox box_in_frame(const InfluenceRecord& frame, const Points& points) {
    DoubleBox box;
    for (const glm::dvec3& p : points) box.add(in_frame(frame, p));
    return box;
}

/// The frustum from `eye` that holds the lines; none where they go all ways.
std::optional<InfluenceArea> point_area(const std::vector<Line>& lines, const glm::dvec3& eye, const DoubleBox& scene) {
    std::vector<glm::dvec3> ways; // to the far ends
    glm::dvec3 direction(0.0);
    for (const Line& line : lines) {
        const glm::dvec3 from = line.from - eye, to = line.to - eye;
        ways.push_back(glm::length(from) > glm::length(to) ? from : to);
        if (glm::length(ways.back()) > 0.0)
            direction += glm::normalize(ways.back());
        else
            ways.pop_back();
    }
    if (!(glm::length(direction) > 0.5 * static_cast<double>(lines.size()))) return std::nullopt;
    InfluenceArea area;
    area.kind = AreaKind::point;
    area.origin = eye;
    area.direction = direction;
    area.near = 0.5, area.far = 1.0;
    if (!area_fault(area).empty()) return std::nullopt;
    const InfluenceRecord frame = influence_records({&area, 1})[0];
    area.half_width = area.half_height = 0x1p-10;
    for (const glm::dvec3& way : ways) {
        const glm::dvec3 p = in_frame(frame, way);
        if (!(p.z > 0x1p-3 * glm::length(p))) return std::nullopt; // beyond 80 degrees
        area.half_width = std::max(area.half_width, margin * std::abs(p.x) / p.z);
        area.half_height = std::max(area.half_height, margin * std::abs(p.y) / p.z);
    }
    area.far = 0.0;
    for (const glm::dvec3& corner : scene.corners()) area.far = std::max(area.far, in_frame(frame, corner - eye).z);
    area.near = 0x1p-6 * area.far;
    return area_fault(area).empty() ? std::optional(area) : std::nullopt;
}

/// The box along the lines, from one end of them and the scene to the other.
std::optional<InfluenceArea> plane_area(const std::vector<Line>& lines, const DoubleBox& scene) {
    InfluenceArea area;
    area.direction = lines[0].direction;
    const InfluenceRecord frame = influence_records({&area, 1})[0];
    std::vector<glm::dvec3> ends;
    for (const Line& line : lines) ends.insert(ends.end(), {line.from, line.to});
    const DoubleBox lane = box_in_frame(frame, ends);
    for (const glm::dvec3& corner : scene.corners()) ends.push_back(corner); // rays may begin beside the scene
    const DoubleBox depth = box_in_frame(frame, ends);
    const double spare = small_share * glm::length(scene.extents());
    const glm::dvec3 middle = lane.middle(), half = 0.5 * margin * lane.extents();
    area.origin =
        middle.x * vector(frame.right) + middle.y * vector(frame.up) + (depth.lower.z - spare) * vector(frame.forward);
    area.half_width = std::max(half.x, spare);
    area.half_height = std::max(half.y, spare);
    area.far = depth.extents().z + 2.0 * spare;
    return area_fault(area).empty() ? std::optional(area) : std::nullopt;
}

bool is_parallel(const Line& a, const Line& b) { // within half a degree, either way
    return glm::length(glm::cross(a.direction, b.direction)) < 0.0087;
}

} // namespace

std::vector<Line> lines_of(const std::vector<Ray>& rays, const std::vector<Hit>& hits) {
    std::vector<Line> lines;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const glm::dvec3 d = vector(rays[i].direction), from = vector(rays[i].origin);
        const double end = std::min(rays[i].t_max, hits[i].t);
        const glm::dvec3 to = from + end * d;
        if (glm::length(d) > 0.0 && end >= rays[i].t_min && is_finite(from) && is_finite(to))
            lines.push_back({rays[i], from, to, glm::normalize(d)});
    }
    return lines;
}

std::vector<LineArea> areas_of_lines(std::vector<Line> lines, const DoubleBox& scene) {
    std::vector<LineArea> found;
    if (lines.size() < least_lines) return found;
    if (const auto eye = common_point(lines, glm::length(scene.extents()))) {
        if (const auto area = point_area(lines, *eye, scene)) found.push_back({*area, std::move(lines)});
        return found;
    }
    while (lines.size() >= least_lines) {
        const Line first = lines[0];
        const auto rest =
            std::stable_partition(lines.begin(), lines.end(), [&](const Line& l) { return is_parallel(l, first); });
        std::vector<Line> group(lines.begin(), rest);
        lines.erase(lines.begin(), rest);
        if (group.size() < least_lines) continue;
        if (const auto area = plane_area(group, scene)) found.push_back({*area, std::move(group)});
    }
    return found;
}

} // namespace boxwood
