// SPDX-License-Identifier: MIT
#pragma once

#include "boxwood/topology.hpp"
#include "shared/aabb.h"

namespace boxwood {

/// The axis-aligned box of every node of `topology`, bottom-up in one launch (dissertation 3.3.4): 2n boxes by node
/// index, those of unused slots empty. `boxes` are the primitives' boxes in their own order. Each box is the exact hull
/// of those below it. O(n).
Buffer<Aabb> aabb_volumes(Device& device, const Topology& topology, BufferView<const Aabb> boxes);

} // namespace boxwood
