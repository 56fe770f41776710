// SPDX-License-Identifier: MIT
#include "boxwood/collapse.hpp"
#include "boxwood/reduce.hpp"
#include "runtime/launch.hpp"

namespace boxwood {

namespace {

std::uint32_t measure_depth(Device& device, const Topology& topology) {
    const auto count = static_cast<std::uint32_t>(topology.size());
    const Buffer<std::uint32_t> heights = make_scratch<std::uint32_t>(device, count, "heights of nodes");
    const Buffer<std::uint32_t> arrivals = make_scratch<std::uint32_t>(device, count, "arrivals at splits");
    const Buffer<std::uint32_t> depth = make_scratch<std::uint32_t>(device, 1, "depth");
    fill<std::uint32_t>(device, heights, 1);
    fill<std::uint32_t>(device, arrivals, 0);
    const Slices slices = cut(device, count);
    launch(device, {"hierarchy/depth.cl", "node_heights"}, "node heights", slices.slices, topology.children,
           topology.parents, topology.far_ends, arrivals, heights, count, slices.length);
    reduce<std::uint32_t>(device, heights, Operator::max, depth);
    return download(device, depth)[0];
}

BinaryLayout collapse(Device& device, const Topology& topology, BufferView<const Aabb> volumes,
                      const Geometry* geometry) {
    const auto count = static_cast<std::uint32_t>(topology.size());
    const Defines defines{{"TRIANGLE_LEAVES", geometry ? "1" : "0"}};
    BinaryLayout layout;
    layout.nodes = make_scratch<BinaryNode>(device, count, "binary nodes");
    launch(device, {"hierarchy/collapse_binary.cl", "binary_nodes", defines}, "binary nodes", count, volumes,
           topology.children, topology.parents, topology.order, layout.nodes, count);
    if (geometry) {
        layout.triangles = make_scratch<Triangle>(device, count, "triangle records");
        const Slices slices = cut(device, count);
        launch(device, {"hierarchy/collapse_binary.cl", "triangle_records", defines}, "triangle records", slices.slices,
               topology.order, topology.offsets, geometry->positions, geometry->triangles, layout.triangles,
               static_cast<std::uint32_t>(topology.trees()), count, slices.length);
    }
    layout.depth = measure_depth(device, topology);
    return layout;
}

} // namespace

BinaryLayout collapse_binary(Device& device, const Topology& topology, BufferView<const Aabb> volumes,
                             const Geometry& geometry) {
    return collapse(device, topology, volumes, &geometry);
}

BinaryLayout collapse_binary(Device& device, const Topology& topology, BufferView<const Aabb> volumes) {
    return collapse(device, topology, volumes, nullptr);
}

} // namespace boxwood
