// SPDX-License-Identifier: MIT
#include "boxwood/volumes.hpp"

#include "runtime/launch.hpp"

namespace boxwood {

Buffer<Aabb> aabb_volumes(Device& device, const Topology& topology, BufferView<const Aabb> boxes) {
    const std::size_t count = topology.size();
    Buffer<Aabb> volumes = make_scratch<Aabb>(device, 2 * count, "boxes of nodes");
    Buffer<std::uint32_t> arrivals = make_scratch<std::uint32_t>(device, count, "arrivals at splits");
    fill(device, arrivals, 0);
    const Slices slices = cut(device, count);
    launch(device, {"volumes/volumes.cl", "aabb_volumes"}, "node boxes", slices.slices, boxes, topology.order,
           topology.children, topology.parents, topology.far_ends, arrivals, volumes, static_cast<std::uint32_t>(count),
           slices.length);
    launch(device, {"volumes/volumes.cl", "empty_unused"}, "unused slots", topology.trees(), topology.offsets, volumes,
           static_cast<std::uint32_t>(topology.trees()));
    return volumes;
}

} // namespace boxwood
