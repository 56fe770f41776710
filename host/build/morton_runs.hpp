// SPDX-License-Identifier: MIT
// Where something small is beside something large, many primitives of the small share one code.
#pragma once

#include <cstdint>

#include "boxwood/morton.hpp"
#include "build/lbvh.hpp"
#include "shared/aabb.h"

namespace boxwood {

/// Primitives with equal codes that are worth codes of their own. Splits by position cost rays up to as many tests in a
/// cell; ordinary scenes have hardly a run of that many.
inline constexpr std::uint32_t long_run = 8;

/// Parts long runs of equal keys by codes of 30 bits within the bounds of their centres, in rounds of launches over all
/// runs of all trees, until no run is long but those of centres that no bits part. Changes `order` and `gaps` within
/// runs, and nothing where there is no long run. A round makes runs 2^9 times smaller or more, so floats bound their
/// number. `keys` are sorted, `order` with them, `gaps` from key_gaps, `offsets` as in Topology. O(n) by round, and one
/// wait.
template <class Key>
void partition_long_runs(Device& device, BufferView<const Aabb> boxes, BufferView<const Key> keys, KeyFormat format,
                         BufferView<const std::uint32_t> offsets, BufferView<std::uint32_t> order,
                         BufferView<Gap> gaps);

} // namespace boxwood
