// SPDX-License-Identifier: MIT
#include "boxwood/trace.hpp"
#include "traverse/specialise.hpp"

namespace boxwood {

void any_hit(Device& device, const Tree& tree, BufferView<const Ray> rays, BufferView<std::uint32_t> hits,
             const TraceOptions& options) {
    if (tree.empty()) return fill(device, hits, 0u);
    const Slices slices = cut_rays(device, rays.size());
    const TreeArrays& arrays = tree.arrays();
    visit_layout(arrays, [&](const auto& bottom, const auto& top) {
        launch(device, traversal_kernel(tree, Query::any, options), "any hit", slices.slices, bottom.nodes,
               bottom.leaves, top.nodes, arrays.instances, arrays.areas, arrays.area_nodes, arrays.area_items, rays,
               static_cast<std::uint32_t>(rays.size()), slices.length, arrays.sphere, hits);
    });
}

} // namespace boxwood
