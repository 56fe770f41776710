// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "boxwood/morton.hpp"
#include "boxwood/topology.hpp"

namespace boxwood {

/// How far apart neighbours in sorted order are; see cl/build/gaps.h.
using Gap = std::uint16_t;

/// Most rounds in which codes are given: the first, and those of long runs (see morton_runs.hpp).
inline constexpr std::uint32_t most_rounds = 512;

/// What tells the gaps of a round from those of other rounds: a round's are below those of earlier ones.
constexpr std::uint32_t gap_rank(std::uint32_t round) { return 32 + 64 * (most_rounds - round); }
static_assert(gap_rank(0) + 64 < 0xffff, "gaps do not fit their type");

/// The gaps after sorted positions by keys alone, equal ones by position. O(n).
template <class Key>
Buffer<Gap> key_gaps(Device& device, BufferView<const Key> keys, KeyFormat format, std::size_t trees);

/// The radix trees over positions with these gaps, in one launch. `order` and `offsets` are moved into the result.
/// O(n).
Topology radix_trees(Device& device, BufferView<const Gap> gaps, Buffer<std::uint32_t> order,
                     Buffer<std::uint32_t> offsets);

} // namespace boxwood
