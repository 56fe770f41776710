// SPDX-License-Identifier: MIT
// What the binary layouts have beside their nodes, whatever their volumes.
#pragma once

#include <cstdint>

#include "boxwood/collapse.hpp"
#include "runtime/launch.hpp"

namespace boxwood {

/// The triangle at each sorted position, `names` as for collapse_binary. O(n).
Buffer<Triangle> triangle_records(Device& device, const Topology& topology, const Geometry& geometry,
                                  BufferView<const std::uint32_t> names = {});

/// Inner nodes on the longest path from a root, the root over one primitive being one. Waits. O(n).
std::uint32_t measure_depth(Device& device, const Topology& topology);

/// The macros of cl/layout/children.h.
inline Defines leaf_defines(const Geometry* geometry) { return {{"TRIANGLE_LEAVES", geometry ? "1" : "0"}}; }

/// Leaves and depth of a BinaryLayout or OrientedLayout.
template <class Layout>
void add_leaves(Device& device, const Topology& topology, const Geometry* geometry,
                BufferView<const std::uint32_t> names, Layout& layout) {
    if (geometry) layout.leaves = triangle_records(device, topology, *geometry, names);
    layout.depth = measure_depth(device, topology);
}

} // namespace boxwood
