// SPDX-License-Identifier: MIT
// What the binary layouts have in common, whatever their volumes.
#pragma once

#include <cstdint>

#include "boxwood/geometry.hpp"
#include "boxwood/topology.hpp"
#include "shared/triangle.h"

namespace boxwood {

/// Inner nodes on the longest path from a root, the root over one primitive being one. Waits. O(n).
std::uint32_t measure_depth(Device& device, const Topology& topology);

/// The triangle at each sorted position, `names` as for collapse_binary. O(n).
Buffer<Triangle> triangle_records(Device& device, const Topology& topology, const Geometry& geometry,
                                  BufferView<const std::uint32_t> names = {});

} // namespace boxwood
