// SPDX-License-Identifier: MIT
#include "boxwood/collapse.hpp"
#include "layout/triangle_records.hpp"

namespace boxwood {

BinaryLayout collapse_binary(Device& device, const Topology& topology, BufferView<const Aabb> volumes,
                             const Geometry* geometry, BufferView<const std::uint32_t> names) {
    const auto count = static_cast<std::uint32_t>(topology.size());
    BinaryLayout layout;
    layout.nodes = make_scratch<BinaryNode>(device, count, "binary nodes");
    launch(device, {"layout/collapse_binary.cl", "binary_nodes", leaf_defines(geometry)}, "binary nodes", count,
           volumes, topology.children, topology.parents, topology.order, layout.nodes, count);
    add_leaves(device, topology, geometry, names, layout);
    return layout;
}

} // namespace boxwood
