// SPDX-License-Identifier: MIT
#include "boxwood/collapse.hpp"
#include "hierarchy/binary_parts.hpp"
#include "runtime/launch.hpp"

namespace boxwood {

namespace {

OrientedLayout collapse(Device& device, const Topology& topology, BufferView<const Aabb> volumes,
                        BufferView<const Obb> boxes, const Geometry* geometry) {
    const auto count = static_cast<std::uint32_t>(topology.size());
    OrientedLayout layout;
    layout.nodes = make_scratch<OrientedNode>(device, count, "oriented nodes");
    launch(device, {"hierarchy/collapse_oriented.cl", "oriented_nodes", {{"TRIANGLE_LEAVES", geometry ? "1" : "0"}}},
           "oriented nodes", count, volumes, boxes, topology.children, topology.parents, topology.order, layout.nodes,
           count);
    if (geometry) layout.triangles = triangle_records(device, topology, *geometry);
    layout.depth = measure_depth(device, topology);
    return layout;
}

} // namespace

OrientedLayout collapse_oriented(Device& device, const Topology& topology, BufferView<const Aabb> volumes,
                                 BufferView<const Obb> boxes, const Geometry& geometry) {
    return collapse(device, topology, volumes, boxes, &geometry);
}

OrientedLayout collapse_oriented(Device& device, const Topology& topology, BufferView<const Aabb> volumes,
                                 BufferView<const Obb> boxes) {
    return collapse(device, topology, volumes, boxes, nullptr);
}

} // namespace boxwood
