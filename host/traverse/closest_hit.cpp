// SPDX-License-Identifier: MIT
#include <limits>
#include <span>
#include <vector>

#include "boxwood/trace.hpp"
#include "traverse/specialise.hpp"

namespace boxwood {

namespace {

void write_misses(Device& device, BufferView<Hit> hits) {
    const Hit miss{std::numeric_limits<float>::infinity(), 0.0f, 0.0f, BOXWOOD_NONE, BOXWOOD_NONE};
    const std::vector<Hit> misses(hits.size(), miss);
    write(device, std::span<const Hit>(misses), hits);
}

void trace(Device& device, const Tree& tree, BufferView<const Ray> rays, BufferView<Hit> hits,
           BufferView<RayStatistics> statistics, Query query, const TraceOptions& options) {
    const Slices slices = cut_rays(device, rays.size());
    const KernelRef kernel = traversal_kernel(tree, query, options);
    const auto ray_count = static_cast<std::uint32_t>(rays.size());
    const auto instance_count =
        tree.first_triangles.size() == 0 ? 0u : static_cast<std::uint32_t>(tree.first_triangles.size() - 1);
    const auto run = [&](const auto& nodes, const auto& leaves, const auto& top) {
        launch(device, kernel, "closest hit", slices.slices, nodes, leaves, top, tree.instances, tree.areas,
               tree.area_nodes, tree.area_items, tree.first_triangles, instance_count, rays, ray_count, slices.length,
               tree.sphere, hits, statistics);
    };
    if (tree.bounds != Bounds::aabb)
        run(tree.oriented_nodes, tree.triangles, tree.oriented_top);
    else if (tree.layout == Layout::wide8)
        run(tree.wide_nodes, tree.blocks, tree.wide_top);
    else
        run(tree.binary_nodes, tree.triangles, tree.binary_top);
}

} // namespace

void closest_hit(Device& device, const Tree& tree, BufferView<const Ray> rays, BufferView<Hit> hits,
                 const TraceOptions& options) {
    if (tree.empty()) return write_misses(device, hits);
    trace(device, tree, rays, hits, {}, Query::closest, options);
}

void closest_hit(Device& device, const Tree& tree, BufferView<const Ray> rays, BufferView<Hit> hits,
                 BufferView<RayStatistics> statistics, const TraceOptions& options) {
    if (tree.empty()) {
        const std::vector<RayStatistics> none(statistics.size());
        write(device, std::span<const RayStatistics>(none), statistics);
        return write_misses(device, hits);
    }
    trace(device, tree, rays, hits, statistics, Query::closest_with_statistics, options);
}

} // namespace boxwood
