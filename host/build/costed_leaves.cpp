// SPDX-License-Identifier: MIT
#include "boxwood/costed_leaves.hpp"

#include "runtime/launch.hpp"

namespace boxwood {

Buffer<std::uint32_t> costed_leaves(Device& device, const Topology& topology, BufferView<const Aabb> volumes,
                                    BufferView<const Aabb> tree_bounds, BufferView<const InfluenceRecord> areas,
                                    BufferView<const std::uint32_t> area_starts, float box_cost, float primitive_cost) {
    const std::size_t count = topology.size();
    Buffer<std::uint32_t> leaves = make_scratch<std::uint32_t>(device, count, "leaves");
    fill(device, leaves, 0); // unused slots are none
    Buffer<float> costs = make_scratch<float>(device, count, "costs of subtrees");
    Buffer<std::uint32_t> arrivals = make_scratch<std::uint32_t>(device, count, "arrivals at splits");
    fill(device, arrivals, 0);
    const Slices slices = cut(device, count);
    launch(device, {"build/costed_leaves.cl", "costed_leaves"}, "costed leaves", slices.slices, volumes,
           topology.children, topology.parents, topology.far_ends, arrivals, topology.offsets, tree_bounds, areas,
           area_starts, costs, leaves, box_cost, primitive_cost, static_cast<std::uint32_t>(topology.trees()),
           static_cast<std::uint32_t>(count), slices.length);
    return leaves;
}

} // namespace boxwood
