// SPDX-License-Identifier: MIT
#include "layout/triangle_records.hpp"

#include <algorithm>

#include "volumes/node_levels.hpp"

namespace boxwood {

Buffer<Triangle> triangle_records(Device& device, const Topology& topology, const Geometry& geometry,
                                  BufferView<const std::uint32_t> names) {
    const auto count = static_cast<std::uint32_t>(topology.size());
    Buffer<Triangle> records = make_scratch<Triangle>(device, count, "triangle records");
    const Slices slices = cut(device, count);
    launch(device, {"layout/triangle_records.cl", "triangle_records", {{"NAMED", names.size() > 0 ? "1" : "0"}}},
           "triangle records", slices.slices, topology.order, topology.offsets, names, geometry.positions,
           geometry.triangles, records, static_cast<std::uint32_t>(topology.trees()), count, slices.length);
    return records;
}

std::uint32_t measure_depth(Device& device, const Topology& topology) {
    return std::max(node_heights(device, topology).greatest, 1u);
}

} // namespace boxwood
