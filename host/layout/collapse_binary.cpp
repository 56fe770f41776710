// SPDX-License-Identifier: MIT
#include <algorithm>

#include "boxwood/collapse.hpp"
#include "layout/triangle_records.hpp"
#include "runtime/launch.hpp"
#include "volumes/node_levels.hpp"

namespace boxwood {

namespace {

/// Inner nodes on the longest path from a root, the root over one primitive being one. Waits. O(n).
std::uint32_t measure_depth(Device& device, const Topology& topology) {
    return std::max(node_heights(device, topology).greatest, 1u);
}

/// What both layouts of two children have beside their nodes.
template <class Layout>
void add_leaves(Device& device, const Topology& topology, const Geometry* geometry,
                BufferView<const std::uint32_t> names, Layout& layout) {
    if (geometry) layout.leaves = triangle_records(device, topology, *geometry, names);
    layout.depth = measure_depth(device, topology);
}

Defines leaf_defines(const Geometry* geometry) { return {{"TRIANGLE_LEAVES", geometry ? "1" : "0"}}; }

} // namespace

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
