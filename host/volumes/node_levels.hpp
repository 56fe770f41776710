// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "boxwood/topology.hpp"

namespace boxwood {

/// The height of each inner node, 0 for unused slots, and the greatest; a node above leaves alone has 1.
struct NodeHeights {
    Buffer<std::uint32_t> heights;
    std::uint32_t greatest = 0;
};

/// Waits for the greatest. O(n).
NodeHeights node_heights(Device& device, const Topology& topology);

/// The inner nodes of all trees by height: height 1 is above leaves alone, and a node comes after both of its children.
struct NodeLevels {
    Buffer<std::uint32_t> nodes; ///< Ascending by height, then by index; unused slots come first.
    /// starts[h] .. starts[h + 1] - 1 are the nodes of height h, 1 <= h <= height().
    std::vector<std::uint32_t> starts;

    std::uint32_t height() const { return static_cast<std::uint32_t>(starts.size()) - 2; }
};

/// Waits twice, for the height and for where the levels start. O(n).
NodeLevels node_levels(Device& device, const Topology& topology);

} // namespace boxwood
