// SPDX-License-Identifier: MIT
#include "boxwood/collapse.hpp"
#include "hierarchy/binary_parts.hpp"
#include "runtime/launch.hpp"

namespace boxwood {

namespace {

BinaryLayout collapse(Device& device, const Topology& topology, BufferView<const Aabb> volumes,
                      const Geometry* geometry, BufferView<const std::uint32_t> names) {
    const auto count = static_cast<std::uint32_t>(topology.size());
    BinaryLayout layout;
    layout.nodes = make_scratch<BinaryNode>(device, count, "binary nodes");
    launch(device, {"hierarchy/collapse_binary.cl", "binary_nodes", {{"TRIANGLE_LEAVES", geometry ? "1" : "0"}}},
           "binary nodes", count, volumes, topology.children, topology.parents, topology.order, layout.nodes, count);
    if (geometry) layout.triangles = triangle_records(device, topology, *geometry, names);
    layout.depth = measure_depth(device, topology);
    return layout;
}

} // namespace

BinaryLayout collapse_binary(Device& device, const Topology& topology, BufferView<const Aabb> volumes,
                             const Geometry& geometry, BufferView<const std::uint32_t> names) {
    return collapse(device, topology, volumes, &geometry, names);
}

BinaryLayout collapse_binary(Device& device, const Topology& topology, BufferView<const Aabb> volumes) {
    return collapse(device, topology, volumes, nullptr, {});
}

} // namespace boxwood
