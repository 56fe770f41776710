// SPDX-License-Identifier: MIT
// The leaves of the binary layouts, whatever their volumes.
#pragma once

#include <cstdint>

#include "boxwood/geometry.hpp"
#include "boxwood/topology.hpp"
#include "shared/triangle.h"

namespace boxwood {

/// The triangle at each sorted position, `names` as for collapse_binary. O(n).
Buffer<Triangle> triangle_records(Device& device, const Topology& topology, const Geometry& geometry,
                                  BufferView<const std::uint32_t> names = {});

} // namespace boxwood
