// SPDX-License-Identifier: MIT
// Influence areas in reports.
#pragma once

#include <string>

#include "cli/report.hpp"

namespace boxwood::cli {

/// What trees and areas take, as in the paper's 9.6, in bytes.
struct AreaMemory {
    std::uint64_t global_tree = 0;
    std::uint64_t local_trees = 0;
    std::uint64_t areas = 0;
    std::uint64_t index = 0;
};

/// O(nodes).
AreaMemory area_memory(const TreeImage& tree);

/// "probe": [{"rays", "count", "kind", "global_cost", "local_cost", "kept"}] of areas that were judged, those of lights
/// or of a probe. Of a tree with local trees or one that was to have them: "areas": {"kept", "index", "triangles" (by
/// area, of a tree that was built), "global_tree_bytes", "local_tree_bytes", "area_bytes", "index_bytes"}.
void add_areas(const TreeImage& tree, const Prepared& prepared, Json& report);

/// The same as lines for a summary; empty without areas.
std::string area_summary(const TreeImage& tree, const Prepared& prepared);

} // namespace boxwood::cli
