// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "shared/area.h"

namespace boxwood {

/// How the areas that a point lies in are found: by trying the box of each, by an octree of five levels (paper 6.1.1,
/// thesis 3.3), or by a k-d tree whose planes are sides of their boxes.
enum class AreaIndexKind { automatic, list, octree, kd };

/// The words used in options, reports and on the command line. to_area_index throws InputError listing them.
std::string_view name(AreaIndexKind kind);
AreaIndexKind to_area_index(std::string_view word);

/// A tree of cells, root 0; a list is a single leaf.
struct AreaIndex {
    AreaIndexKind kind = AreaIndexKind::list; ///< never automatic
    std::vector<AreaNode> nodes;
    std::vector<std::uint32_t> items; ///< Lists of the leaves.

    std::uint64_t bytes() const { return nodes.size() * sizeof(AreaNode) + items.size() * sizeof(std::uint32_t); }
};

/// How far a point at most lies outside the region along each axis where area_contains (cl/influence/influence.h)
/// accepts it, and more: that is less than 2^-19 (1 + t) of the extents, t being the tangents.
float area_rounding(const LocalArea& area);

/// automatic: the list for up to eight areas, else the k-d tree. Empty for no areas. O(areas) in memory, O(areas log
/// areas).
AreaIndex build_area_index(std::span<const LocalArea> areas, AreaIndexKind kind);

/// The areas whose region holds the point, ascending; the same for every kind of index.
std::vector<std::uint32_t> find_areas(const AreaIndex& index, std::span<const LocalArea> areas, const glm::vec3& point);

} // namespace boxwood
