// SPDX-License-Identifier: MIT
#pragma once

#include "boxwood/topdown.hpp"

namespace boxwood {

/// Throws InputError for an option out of its range.
void check(const TopDownOptions& options);

/// topdown(), of trees whose bounds are known. Marks leaves and counts only if `leaves` is wanted.
TopDownTree topdown_within(Device& device, BufferView<const Aabb> boxes, BufferView<const float> centres,
                           Buffer<std::uint32_t> offsets, BufferView<const Aabb> tree_bounds,
                           BufferView<const InfluenceRecord> areas, BufferView<const std::uint32_t> area_starts,
                           const TopDownOptions& options, bool leaves);

/// Bytes that a build over `primitives` with `bins` bins needs at once, beside boxes and topology, and its largest
/// buffer.
struct TopDownBytes {
    std::uint64_t all;
    std::uint64_t largest;
};
TopDownBytes topdown_bytes(const Device& device, std::uint64_t primitives, std::uint32_t bins);

} // namespace boxwood
