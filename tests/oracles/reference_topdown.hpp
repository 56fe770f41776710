// SPDX-License-Identifier: MIT
// Oracle of top-down builders: recursion over lists of primitives, every plane tried by going through all of them. In
// float, with the same formulas as the strategies, so that equal trees are asked for.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "boxwood/topdown.hpp"
#include "oracles/tree_checker.hpp"

namespace boxwood::test {

/// A strategy on the host.
struct ReferenceRules {
    std::function<float(const Aabb&root, const Aabb&box)> measure, fallback_measure;
    std::function<std::array<float, 3>(const Aabb&box, std::uint32_t level)> axes, fallback_axes;
    bool thresholds = true; ///< threshold_stop; else a node never stops.
};

float reference_surface(const Aabb& root, const Aabb& box);
std::array<float, 3> reference_longest(const Aabb& box, std::uint32_t level);
std::array<float, 3> reference_all(const Aabb& box, std::uint32_t level);

/// surface_measure, longest_axes and threshold_stop, as TopDownOptions says unless told otherwise.
ReferenceRules reference_rules();

struct ReferenceTree {
    HostTopology topology;
    std::vector<std::uint32_t> leaves;
    std::uint64_t splits = 0, axes_tried = 0, fallbacks = 0;
    std::uint32_t depth = 0;
};

/// `centres` may be empty: the middles of the boxes.
ReferenceTree reference_topdown(const std::vector<Aabb>& boxes, const std::vector<float>& centres,
                                const std::vector<std::uint32_t>& offsets, const TopDownOptions& options,
                                const ReferenceRules& rules);

} // namespace boxwood::test
