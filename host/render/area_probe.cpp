// SPDX-License-Identifier: MIT
#include "boxwood/area_probe.hpp"

#include <utility>

#include "boxwood/rays.hpp"
#include "boxwood/trace.hpp"
#include "influence/line_areas.hpp"
#include "layout/tree_arrays.hpp"

namespace boxwood {

namespace {

constexpr std::uint32_t side = 16;

glm::dvec3 vector(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

struct Cost {
    double tests = 0.0;
    std::uint64_t answered = 0;
};

Cost cost_of(Device& device, const Tree& tree, const std::vector<Line>& lines) {
    std::vector<Ray> rays;
    for (const Line& line : lines) rays.push_back(line.ray);
    const Buffer<Ray> source = upload(device, rays, "probe rays");
    Buffer<Hit> hits = make_buffer<Hit>(device, rays.size(), "probe hits");
    Buffer<RayStatistics> statistics = make_buffer<RayStatistics>(device, rays.size(), "probe statistics");
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
        const bool lookup = with.arrays().areas.size() > 0;
        ProbedArea result{area, rays, lines.size(), cost_of(device, tree, lines).tests, cost.tests, false};
        result.local_cost += lookup ? 1.0 : 0.0;
        // Where every ray goes on to the global tree, fewer tests still take more time: two searches and the lookup.
        result.kept = (cost.answered > 0 || !lookup) && result.local_cost < result.global_cost;
        return result;
    }
};

/// Rays of an area from what its own 16 x 16 rays hit back to where those start: shadow rays, where the area is a
/// light's.
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
    Buffer<Hit> hits = make_buffer<Hit>(device, rays.size(), "probe hits");
    closest_hit(device, tree, upload(device, rays, "probe rays"), hits);
    const std::vector<Hit> found = download(device, hits);
    std::vector<Ray> hitting;
    std::vector<Hit> hit;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (found[i].primitive == BOXWOOD_NONE) continue;
        hitting.push_back(rays[i]);
        hit.push_back(found[i]);
    }
    std::vector<Line> lines;
    for (const Line& line : lines_of(hitting, hit)) {
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
    validate(areas, "influence areas");
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
    const DoubleBox box = *world_box(scene);
    const auto make = [&](const char* label) { return make_buffer<Ray>(device, side * side, label); };
    Buffer<Ray> primary = make("probe rays"), shadow = make("probe rays"), diffuse = make("probe rays");
    Buffer<Hit> hits = make_buffer<Hit>(device, side * side, "probe hits");
    primary_rays(device, camera, side, side, primary);
    closest_hit(device, tree, primary, hits);
    shadow_rays(device, geometry, primary, hits, default_light(scene), shadow);
    diffuse_rays(device, geometry, primary, hits, 1, diffuse);

    std::uint64_t all = 0;
    for (const auto& [rays, name] : {std::pair{&primary, "primary"}, {&shadow, "shadow"}, {&diffuse, "diffuse"}}) {
        closest_hit(device, tree, *rays, hits);
        const std::vector<Line> lines = lines_of(download(device, *rays), download(device, hits));
        all += lines.size();
        for (const LineArea& found : areas_of_lines(lines, box))
            probed.push_back(control.judge(found.area, found.lines, name));
    }
    for (ProbedArea& each : probed) each.area.share = static_cast<double>(each.count) / static_cast<double>(all);
    return probed;
}

} // namespace boxwood
