// SPDX-License-Identifier: MIT
#include "hierarchy/local_trees.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "boxwood/influence.hpp"
#include "hierarchy/area_triangles.hpp"
#include "hierarchy/capacity.hpp"

namespace boxwood {

namespace {

// A ray is taken to be in a region, and to leave it, with errors of some 2^-24 of the largest coordinate, and a triangle is hit
// beside where it is by as much over the sine of the angle that it is met under. Triangles within this share of the largest coordinate
// belong to the local tree too, so that none is missed at an angle of 2^-5 and above, or where the ray is not within it of the side.
constexpr double slack = 0x1p-16;

double reach_of(const Scene& flat, const InfluenceRecord& region) {
    double largest = 0.0;
    for (const glm::dvec3& corner : corners(region))
        for (int k = 0; k < 3; ++k) largest = std::max(largest, std::abs(corner[k]));
    for (const Mesh& mesh : flat.meshes)
        for (const glm::vec3& p : mesh.positions)
            for (int k = 0; k < 3; ++k) largest = std::max(largest, std::abs(static_cast<double>(p[k])));
    return largest;
}

/// All triangles of the scene, then those of `local` again.
void append_triangles(Device& device, const Scene& flat, const std::vector<std::uint32_t>& local, Geometry& geometry) {
    std::vector<std::uint32_t> indices;
    indices.reserve(3 * local.size());
    for (const std::uint32_t triangle : local)
        for (int k = 0; k < 3; ++k) indices.push_back(flat.meshes[0].triangles[triangle][k]);
    const std::size_t count = geometry.triangles.size();
    Buffer<std::uint32_t> all = make_buffer<std::uint32_t>(device, count + indices.size(), "triangles");
    copy<std::uint32_t>(device, geometry.triangles, all.prefix(count));
    write(device, std::span<const std::uint32_t>(indices), all.view(), count);
    geometry.triangles = std::move(all);
}

} // namespace

InfluenceRecord widened(const InfluenceRecord& region, double by) {
    InfluenceRecord wide = region;
    double back = by; // how far the origin moves against the direction
    if (region.point == 0) {
        wide.half_width = static_cast<float>(region.half_width + by);
        wide.half_height = static_cast<float>(region.half_height + by);
    } else {
        // The sides move outwards by `by` when the eye moves back by that over the sine of half the field of view.
        const auto far_enough = [by](double tangent) { return by * std::sqrt(1.0 + tangent * tangent) / tangent; };
        back = std::max(far_enough(region.half_width), far_enough(region.half_height));
    }
    for (int k = 0; k < 3; ++k) wide.origin[k] = static_cast<float>(region.origin[k] - back * region.forward[k]);
    wide.near = static_cast<float>(region.near + back - by);
    wide.far = static_cast<float>(region.far + back + by);
    return wide;
}

LocalTrees add_local_triangles(Device& device, const Scene& flat, const BuildOptions& options, Layout layout,
                               Geometry& geometry) {
    const Stage stage(device, "areas");
    const std::vector<InfluenceRecord> records = influence_records(options.areas);
    const std::size_t count = geometry.triangle_count();
    LocalTrees trees;
    std::vector<std::uint32_t> names(count);
    std::iota(names.begin(), names.end(), 0u);
    for (const InfluenceRecord& record : records) {
        LocalArea area{record, {}, 0, 0};
        if (area.region.point != 0) area.region.near = 0.0f;
        const InfluenceRecord wide = widened(area.region, slack * reach_of(flat, area.region));
        area.box = enclosing_box(wide);
        const std::vector<std::uint32_t> found =
            download(device, area_triangles(device, geometry.positions, geometry.triangles, wide));
        trees.reports.push_back({found.size()});
        if (found.empty()) continue;
        names.insert(names.end(), found.begin(), found.end());
        trees.areas.push_back(area);
        trees.sizes.push_back(static_cast<std::uint32_t>(found.size()));
        check_capacity(device, layout, Bounds::aabb, names.size(), flat.vertex_count(), 0);
    }
    if (trees.areas.empty()) return trees;
    append_triangles(device, flat, {names.begin() + static_cast<std::ptrdiff_t>(count), names.end()}, geometry);
    trees.names = upload(device, names, "names of triangles");
    return trees;
}

} // namespace boxwood
