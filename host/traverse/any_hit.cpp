// SPDX-License-Identifier: MIT
#include "boxwood/trace.hpp"
#include "traverse/specialise.hpp"

namespace boxwood {

void any_hit(Device& device, const Tree& tree, BufferView<const Ray> rays, BufferView<std::uint32_t> hits,
             const TraceOptions& options) {
    if (tree.empty()) return fill(device, hits, 0u);
    const Slices slices = cut_rays(device, rays.size());
    const KernelRef kernel = traversal_kernel(tree, Query::any, options);
    const auto ray_count = static_cast<std::uint32_t>(rays.size());
    const auto run = [&](const auto& nodes, const auto& leaves, const auto& top) {
        launch(device, kernel, "any hit", slices.slices, nodes, leaves, top, tree.instances, tree.areas,
               tree.area_nodes, tree.area_items, rays, ray_count, slices.length, tree.sphere, hits);
    };
    if (tree.bounds != Bounds::aabb)
        run(tree.oriented_nodes, tree.triangles, tree.oriented_top);
    else if (tree.layout == Layout::wide8)
        run(tree.wide_nodes, tree.blocks, tree.wide_top);
    else
        run(tree.binary_nodes, tree.triangles, tree.binary_top);
}

} // namespace boxwood
