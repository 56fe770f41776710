// SPDX-License-Identifier: MIT
#include "hierarchy/binary_parts.hpp"

#include "boxwood/reduce.hpp"
#include "runtime/launch.hpp"

namespace boxwood {

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

Buffer<Triangle> triangle_records(Device& device, const Topology& topology, const Geometry& geometry) {
    const auto count = static_cast<std::uint32_t>(topology.size());
    Buffer<Triangle> records = make_scratch<Triangle>(device, count, "triangle records");
    const Slices slices = cut(device, count);
    launch(device, {"hierarchy/triangle_records.cl", "triangle_records"}, "triangle records", slices.slices,
           topology.order, topology.offsets, geometry.positions, geometry.triangles, records,
           static_cast<std::uint32_t>(topology.trees()), count, slices.length);
    return records;
}

} // namespace boxwood
