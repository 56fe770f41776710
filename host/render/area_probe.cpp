// SPDX-License-Identifier: MIT
#include "boxwood/area_probe.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "boxwood/rays.hpp"
#include "boxwood/trace.hpp"

namespace boxwood {

namespace {

constexpr std::uint32_t side = 16;
/// A group of fewer is left to the global tree.
constexpr std::size_t least_rays = side;
/// Rays between those of the probe lie beyond the outermost by up to half their distance, a 32nd, and some.
constexpr double margin = 1.0 + 1.0 / side;
/// Lines meet in a point when they pass it by no more than this share of the scene's size.
constexpr double meeting = 0x1p-10;

/// A ray up to its end: where it hits or its interval ends.
struct Line {
    Ray ray;
    glm::dvec3 from, to, direction; ///< direction normalised
};

struct Box {
    glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
    glm::dvec3 corner(int i) const { return {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z}; }
    double size() const { return glm::length(high - low); }
};

Box box_of(const Scene& scene) {
    Box box;
    for (const Instance& instance : scene.instances) {
        for (const glm::vec3& p : scene.meshes[instance.mesh].positions) {
            const glm::dvec3 placed(glm::dmat4(instance.transform) * glm::dvec4(p, 1.0));
            box.low = glm::min(box.low, placed);
            box.high = glm::max(box.high, placed);
        }
    }
    return box;
}

glm::dvec3 vector(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

/// The lines of rays that hit something or have an end.
std::vector<Line> lines_of(const std::vector<Ray>& rays, const std::vector<Hit>& hits) {
    std::vector<Line> lines;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const glm::dvec3 d = vector(rays[i].direction), from = vector(rays[i].origin);
        const double end = std::min(rays[i].t_max, hits[i].t);
        if (glm::length(d) > 0.0 && std::isfinite(end))
            lines.push_back({rays[i], from, from + end * d, glm::normalize(d)});
    }
    return lines;
}

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
        if (glm::length(glm::cross(point - line.from, line.direction)) > meeting * size) return std::nullopt;
    return point;
}

/// Coordinates along right, up and forward of an area's record.
glm::dvec3 in_frame(const InfluenceRecord& frame, const glm::dvec3& v) {
    return {glm::dot(v, vector(frame.right)), glm::dot(v, vector(frame.up)), glm::dot(v, vector(frame.forward))};
}

/// The frustum from `eye` that holds the lines; none where they go all ways.
std::optional<InfluenceArea> point_area(const std::vector<Line>& lines, const glm::dvec3& eye, const Box& box) {
    InfluenceArea area;
    area.kind = AreaKind::point;
    area.origin = eye;
    area.direction = glm::dvec3(0.0);
    const auto far_end = [&](const Line& line) {
        return glm::distance(line.from, eye) > glm::distance(line.to, eye) ? line.from : line.to;
    };
    for (const Line& line : lines)
        if (glm::distance(far_end(line), eye) > 0.0) area.direction += glm::normalize(far_end(line) - eye);
    if (!(glm::length(area.direction) > 0.5 * static_cast<double>(lines.size()))) return std::nullopt;
    area.near = 0.5, area.far = 1.0;
    const InfluenceRecord frame = influence_records(std::vector{area})[0];
    area.half_width = area.half_height = 0x1p-10;
    for (const Line& line : lines) {
        const glm::dvec3 p = in_frame(frame, far_end(line) - eye);
        if (!(p.z > 0x1p-3 * glm::length(p))) return std::nullopt; // beyond 80 degrees
        area.half_width = std::max(area.half_width, margin * std::abs(p.x) / p.z);
        area.half_height = std::max(area.half_height, margin * std::abs(p.y) / p.z);
    }
    area.far = 0.0;
    for (int i = 0; i < 8; ++i) area.far = std::max(area.far, in_frame(frame, box.corner(i) - eye).z);
    area.near = 0x1p-6 * area.far;
    return area.far > 0.0 ? std::optional(area) : std::nullopt;
}

/// The box along the lines, from one end of the scene to the other.
InfluenceArea plane_area(const std::vector<Line>& lines, const Box& box) {
    InfluenceArea area;
    area.direction = lines[0].direction;
    const InfluenceRecord frame = influence_records(std::vector{area})[0];
    Box lane, depth;
    for (const Line& line : lines) {
        for (const glm::dvec3& end : {line.from, line.to}) {
            lane.low = glm::min(lane.low, in_frame(frame, end));
            lane.high = glm::max(lane.high, in_frame(frame, end));
        }
    }
    for (int i = 0; i < 8; ++i) {
        depth.low = glm::min(depth.low, in_frame(frame, box.corner(i)));
        depth.high = glm::max(depth.high, in_frame(frame, box.corner(i)));
    }
    const glm::dvec3 middle = 0.5 * (lane.low + lane.high), half = 0.5 * margin * (lane.high - lane.low);
    const double spare = 0x1p-10 * box.size();
    area.origin =
        middle.x * vector(frame.right) + middle.y * vector(frame.up) + (depth.low.z - spare) * vector(frame.forward);
    area.half_width = std::max(half.x, spare);
    area.half_height = std::max(half.y, spare);
    area.far = depth.high.z - depth.low.z + 2.0 * spare;
    return area;
}

bool is_parallel(const Line& a, const Line& b) { // within half a degree, either way
    return glm::length(glm::cross(a.direction, b.direction)) < 0.0087;
}

/// Lines through one point make one area; of the others each direction that many share.
std::vector<std::pair<InfluenceArea, std::vector<Line>>> find_areas(std::vector<Line> lines, const Box& box) {
    std::vector<std::pair<InfluenceArea, std::vector<Line>>> found;
    if (lines.size() < least_rays) return found;
    if (const auto eye = common_point(lines, box.size())) {
        if (const auto area = point_area(lines, *eye, box)) found.emplace_back(*area, lines);
        return found;
    }
    while (!lines.empty()) {
        const Line first = lines[0];
        const auto rest =
            std::partition(lines.begin(), lines.end(), [&](const Line& l) { return is_parallel(l, first); });
        std::vector<Line> group(lines.begin(), rest);
        lines.erase(lines.begin(), rest);
        if (group.size() >= least_rays) found.emplace_back(plane_area(group, box), std::move(group));
    }
    return found;
}

struct Cost {
    double tests = 0.0;
    std::uint64_t answered = 0;
};

Cost cost_of(Device& device, const Tree& tree, const std::vector<Line>& lines) {
    std::vector<Ray> rays;
    for (const Line& line : lines) rays.push_back(line.ray);
    const Buffer<Ray> source = upload(device, rays, "probe rays");
    const Buffer<Hit> hits = make_buffer<Hit>(device, rays.size(), "probe hits");
    const Buffer<RayStatistics> statistics = make_buffer<RayStatistics>(device, rays.size(), "probe statistics");
    closest_hit(device, tree, source, hits, statistics);
    Cost cost;
    for (const RayStatistics& each : download(device, statistics)) {
        cost.tests += static_cast<double>(each.volumes) + each.primitives;
        cost.answered += each.areas == 2;
    }
    cost.tests /= static_cast<double>(rays.size());
    return cost;
}

/// A scene's tree without areas, which those that an area comes with are set beside.
struct Control {
    Device& device;
    const Scene& scene;
    BuildOptions options; ///< With areas.
    Tree tree;

    Control(Device& on, const Scene& of, BuildOptions with) : device(on), scene(of), options(std::move(with)) {
        options.areas.clear();
        options.levels = Levels::one;
        BuildOptions plain = options;
        if (needs_areas(plain.builder)) plain.builder = Builder::sah;
        tree = build(device, scene, plain);
    }

    ProbedArea judge(InfluenceArea area, const std::vector<Line>& lines, const std::string& rays) {
        area.share = 1.0; // of these rays
        options.areas = {area};
        const Tree with = build(device, scene, options);
        const Cost cost = cost_of(device, with, lines);
        const bool lookup = with.areas.size() > 0;
        ProbedArea result{area, rays, lines.size(), cost_of(device, tree, lines).tests, cost.tests, false};
        result.local_cost += lookup ? 1.0 : 0.0;
        result.kept = (cost.answered > 0 || !lookup) && result.local_cost < result.global_cost;
        return result;
    }
};

/// Rays of an area from what its own 16 x 16 rays hit back to where those start: shadow rays, where the area is a light's.
std::vector<Line> lines_back(Device& device, const Tree& tree, const InfluenceArea& area) {
    const InfluenceRecord frame = influence_records(std::vector{area})[0];
    std::vector<Ray> rays;
    for (std::uint32_t i = 0; i < side * side; ++i) {
        const double x = area.half_width * ((i % side + 0.5) * 2.0 / side - 1.0);
        const double y = area.half_height * ((i / side + 0.5) * 2.0 / side - 1.0);
        const bool point = area.kind == AreaKind::point;
        const glm::dvec3 across = x * vector(frame.right) + y * vector(frame.up);
        const glm::vec3 from(area.origin + (point ? glm::dvec3(0.0) : across));
        const glm::vec3 d(vector(frame.forward) + (point ? across : glm::dvec3(0.0)));
        rays.push_back(
            {{from.x, from.y, from.z}, static_cast<float>(area.near), {d.x, d.y, d.z}, static_cast<float>(area.far)});
    }
    const Buffer<Hit> hits = make_buffer<Hit>(device, rays.size(), "probe hits");
    closest_hit(device, tree, upload(device, rays, "probe rays"), hits);
    std::vector<Line> lines;
    for (Line& line : lines_of(rays, download(device, hits))) {
        const glm::vec3 from(line.to), d(line.from - line.to);
        // Past the surface that was hit.
        const Ray back{{from.x, from.y, from.z}, 0x1p-10f, {d.x, d.y, d.z}, 1.0f};
        lines.push_back({back, line.to, line.from, -line.direction});
    }
    return lines;
}

} // namespace

std::vector<ProbedArea> judge_areas(Device& device, const Scene& scene, const std::vector<InfluenceArea>& areas,
                                    const BuildOptions& options) {
    std::vector<ProbedArea> judged;
    if (scene.instanced_triangle_count() == 0 || areas.empty()) return judged;
    Control control(device, scene, options);
    for (const InfluenceArea& area : areas) {
        const std::vector<Line> lines = lines_back(device, control.tree, area);
        if (lines.empty())
            judged.push_back({area, "shadow", 0, 0.0, 0.0, false}); // nothing in its light
        else
            judged.push_back(control.judge(area, lines, "shadow"));
        judged.back().area.share = area.share;
    }
    return judged;
}

std::vector<ProbedArea> probe_areas(Device& device, const Scene& scene, const Camera& camera,
                                    const BuildOptions& options) {
    std::vector<ProbedArea> probed;
    if (scene.instanced_triangle_count() == 0) return probed;
    Control control(device, scene, options);
    const Tree& tree = control.tree;
    const Geometry geometry = upload(device, scene);
    const Box box = box_of(scene);
    const auto make = [&](const char* label) { return make_buffer<Ray>(device, side * side, label); };
    const Buffer<Ray> primary = make("probe rays"), shadow = make("probe rays"), diffuse = make("probe rays");
    const Buffer<Hit> hits = make_buffer<Hit>(device, side * side, "probe hits");
    primary_rays(device, camera, side, side, primary);
    closest_hit(device, tree, primary, hits);
    shadow_rays(device, geometry, primary, hits, default_light(scene), shadow);
    diffuse_rays(device, geometry, primary, hits, 1, diffuse);

    std::uint64_t all = 0;
    for (const auto& [rays, name] : {std::pair{&primary, "primary"}, {&shadow, "shadow"}, {&diffuse, "diffuse"}}) {
        closest_hit(device, tree, *rays, hits);
        const std::vector<Line> lines = lines_of(download(device, *rays), download(device, hits));
        all += lines.size();
        for (const auto& [area, own] : find_areas(lines, box)) {
            probed.push_back(control.judge(area, own, name));
        }
    }
    for (ProbedArea& each : probed) each.area.share = static_cast<double>(each.count) / static_cast<double>(all);
    return probed;
}

} // namespace boxwood
