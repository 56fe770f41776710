// SPDX-License-Identifier: MIT
#pragma once

#include "boxwood/build.hpp"

namespace boxwood {

/// Throws CapacityError when building a tree by resolved `options` over `triangles` triangles and `vertices` vertices,
/// with `instances` in a top level (0: none), cannot fit the device whatever its shape turns out to be. Empties the
/// device's pool where that makes the room. O(1), before any work.
void check_capacity(Device& device, const BuildOptions& options, std::uint64_t triangles, std::uint64_t vertices,
                    std::uint64_t instances);

} // namespace boxwood
