// SPDX-License-Identifier: MIT
#include "traverse/ray_cost.hpp"

#include "traverse/specialise.hpp"
#include "volumes/node_levels.hpp"

namespace boxwood {

void ray_visits(Device& device, const MarkedTree& tree, BufferView<const Ray> rays, BufferView<RayVisits> visits,
                BufferView<Hit> hits) {
    const auto count = static_cast<std::uint32_t>(tree.topology.size());
    if (count == 0) {
        fill(device, visits, RayVisits{});
        return closest_hit(device, Tree(), rays, hits);
    }
    const std::uint32_t height = node_heights(device, tree.topology).greatest;
    const KernelRef kernel{
        "traverse/ray_cost.cl",
        "ray_visits",
        {{"STACK_SIZE", std::to_string(stack_entries(std::uint64_t{height} + 1))}, {"PORTABLE_LANES", "0"}}};
    const Slices slices = cut_rays(device, rays.size());
    launch(device, kernel, "ray visits", slices.slices, tree.topology.children, tree.topology.far_ends, tree.leaves,
           tree.volumes, tree.triangles, count, rays, static_cast<std::uint32_t>(rays.size()), slices.length,
           tree.sphere, visits, hits);
}

} // namespace boxwood
