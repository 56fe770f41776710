// SPDX-License-Identifier: MIT
#include "traverse/ray_cost.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include "boxwood/error.hpp"
#include "hierarchy/node_levels.hpp"
#include "traverse/specialise.hpp"

namespace boxwood {

namespace {

std::uint32_t stack_entries(std::uint32_t height) {
    constexpr std::uint64_t least = 32, most = 1u << 18; // as for traversal
    const std::uint64_t entries = std::uint64_t{height} + 1;
    if (entries > most) throw CapacityError("traversal stack entries", entries, most);
    return static_cast<std::uint32_t>(std::bit_ceil(std::max(entries, least)));
}

void write_misses(Device& device, BufferView<RayVisits> visits, BufferView<Hit> hits) {
    fill(device, visits, RayVisits{});
    const Hit miss{std::numeric_limits<float>::infinity(), 0.0f, 0.0f, BOXWOOD_NONE, BOXWOOD_NONE};
    const std::vector<Hit> misses(hits.size(), miss);
    write(device, std::span<const Hit>(misses), hits);
}

} // namespace

void ray_visits(Device& device, const MarkedTree& tree, BufferView<const Ray> rays, BufferView<RayVisits> visits,
                BufferView<Hit> hits) {
    const auto count = static_cast<std::uint32_t>(tree.topology.size());
    if (count == 0) return write_misses(device, visits, hits);
    const std::uint32_t height = node_heights(device, tree.topology).greatest;
    const KernelRef kernel{"traverse/ray_cost.cl",
                           "ray_visits",
                           {{"STACK_SIZE", std::to_string(stack_entries(height))}, {"PORTABLE_LANES", "0"}}};
    const Slices slices = cut_rays(device, rays.size());
    launch(device, kernel, "ray visits", slices.slices, tree.topology.children, tree.topology.far_ends, tree.leaves,
           tree.volumes, tree.triangles, count, rays, static_cast<std::uint32_t>(rays.size()), slices.length, visits,
           hits);
}

} // namespace boxwood
