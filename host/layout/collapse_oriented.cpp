// SPDX-License-Identifier: MIT
#include "boxwood/collapse.hpp"
#include "layout/triangle_records.hpp"

namespace boxwood {

OrientedLayout collapse_oriented(Device& device, const Topology& topology, BufferView<const Aabb> volumes,
                                 BufferView<const Obb> boxes, const Geometry* geometry) {
    const auto count = static_cast<std::uint32_t>(topology.size());
    OrientedLayout layout;
    layout.nodes = make_scratch<OrientedNode>(device, count, "oriented nodes");
    launch(device, {"layout/collapse_oriented.cl", "oriented_nodes", leaf_defines(geometry)}, "oriented nodes", count,
           volumes, boxes, topology.children, topology.parents, topology.order, layout.nodes, count);
    add_leaves(device, topology, geometry, {}, layout);
    return layout;
}

} // namespace boxwood
