// SPDX-License-Identifier: MIT
#include "build/local_trees.hpp"

#include <numeric>
#include <span>

#include "boxwood/influence.hpp"
#include "build/area_triangles.hpp"
#include "build/capacity.hpp"

namespace boxwood {

namespace {

/// All triangles of the scene, then those of `local` again.
void append_triangles(Device& device, const Scene& flat, const std::vector<std::uint32_t>& local, Geometry& geometry) {
    std::vector<std::uint32_t> indices;
    indices.reserve(3 * local.size());
    for (const std::uint32_t triangle : local)
        for (int k = 0; k < 3; ++k) indices.push_back(flat.meshes[0].triangles[triangle][k]);
    const std::size_t count = geometry.triangles.size();
    Buffer<std::uint32_t> all = make_buffer<std::uint32_t>(device, count + indices.size(), "triangles");
    copy(device, geometry.triangles, all.prefix(count));
    write(device, std::span<const std::uint32_t>(indices), all.view(), count);
    geometry.triangles = std::move(all);
}

} // namespace

LocalArea local_area(const InfluenceRecord& record) {
    LocalArea area{record, {}, 0, record.near};
    if (area.region.point != 0) area.region.near = 0.0f;
    area.box = enclosing_box(area.region);
    const float slack = area_rounding(area);
    for (int k = 0; k < 3; ++k) {
        area.box.min[k] -= slack;
        area.box.max[k] += slack;
    }
    return area;
}

LocalTrees add_local_triangles(Device& device, const Scene& flat, const BuildOptions& options, Geometry& geometry) {
    const Stage stage(device, "areas");
    const std::vector<InfluenceRecord> records = influence_records(options.areas);
    const std::size_t count = geometry.triangle_count();
    LocalTrees trees;
    std::vector<InfluenceRecord> rays;
    std::vector<std::uint32_t> names(count);
    std::iota(names.begin(), names.end(), 0u);
    for (const InfluenceRecord& record : records) {
        const LocalArea area = local_area(record);
        const std::vector<std::uint32_t> found =
            download(device, area_triangles(device, geometry.positions, geometry.triangles, area.region));
        trees.reports.push_back({found.size()});
        if (found.empty()) continue;
        names.insert(names.end(), found.begin(), found.end());
        trees.areas.push_back(area);
        rays.push_back(record);
        rays.back().share = 1.0f; // of the rays in its tree
        trees.sizes.push_back(static_cast<std::uint32_t>(found.size()));
        check_capacity(device, options, names.size(), flat.vertex_count(), 0);
    }
    if (trees.areas.empty()) return trees;
    append_triangles(device, flat, {names.begin() + static_cast<std::ptrdiff_t>(count), names.end()}, geometry);
    // The rays of the global tree follow no area.
    std::vector<std::uint32_t> starts(rays.size() + 2, 0u);
    std::iota(starts.begin() + 1, starts.end(), 0u);
    trees.rays = upload(device, rays, "rays of local trees");
    trees.ray_starts = upload(device, starts, "rays of local trees");
    trees.names = upload(device, names, "names of triangles");
    return trees;
}

} // namespace boxwood
