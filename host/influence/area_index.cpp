// SPDX-License-Identifier: MIT
#include "boxwood/area_index.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "boxwood/influence.hpp"
#include "common/words.hpp"
#include "influence/area_cells.hpp"

namespace boxwood {

namespace {

constexpr Words<AreaIndexKind, 4> kinds = {{{"auto", AreaIndexKind::automatic},
                                            {"list", AreaIndexKind::list},
                                            {"octree", AreaIndexKind::octree},
                                            {"kd", AreaIndexKind::kd}}};

/// Levels of an octree, the root's among them.
constexpr std::uint32_t octree_levels = 5;

/// Above, going down a tree is cheaper than trying all boxes.
constexpr std::size_t most_in_list = 8;

/// Entries of lists beyond which nothing is split: areas that are all over each other would be listed in every cell.
constexpr std::size_t entries_per_area = 64, entries_of_few = 1 << 15;

} // namespace

std::string_view name(AreaIndexKind kind) { return word_of(kinds, kind); }
AreaIndexKind to_area_index(std::string_view word) { return value_of(kinds, "area index", word); }

float area_rounding(const LocalArea& area) {
    const InfluenceRecord& region = area.region;
    const float tangents = region.point != 0 ? region.half_width + region.half_height : 0.0f;
    float reach = 0.0f;
    for (int k = 0; k < 3; ++k) reach += area.box.max[k] - area.box.min[k];
    return 0x1p-17f * (1.0f + tangents) * reach;
}

AreaCells::AreaCells(std::span<const LocalArea> areas) : areas_(areas) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    root_.box = {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    root_.areas.resize(areas.size());
    std::iota(root_.areas.begin(), root_.areas.end(), 0u);
    for (const LocalArea& area : areas) {
        for (int k = 0; k < 3; ++k) {
            root_.box.min[k] = std::min(root_.box.min[k], area.box.min[k]);
            root_.box.max[k] = std::max(root_.box.max[k], area.box.max[k]);
        }
        slack_ = std::max(slack_, area_rounding(area));
    }
}

Aabb AreaCells::widened(const Aabb& box) const {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    Aabb wide = box;
    for (int k = 0; k < 3; ++k) { // by a float at least, where they are farther apart than the slack
        wide.min[k] = std::nextafter(wide.min[k] - slack_, -infinity);
        wide.max[k] = std::nextafter(wide.max[k] + slack_, infinity);
    }
    return wide;
}

AreaCell AreaCells::child(const AreaCell& parent, const Aabb& box) const {
    AreaCell cell{box, {}, parent.level + 1};
    const Aabb wide = widened(box);
    for (const std::uint32_t i : parent.areas)
        if (intersects(areas_[i].region, wide)) cell.areas.push_back(i);
    return cell;
}

bool AreaCells::is_homogeneous(const AreaCell& cell) const {
    return std::all_of(cell.areas.begin(), cell.areas.end(),
                       [&](std::uint32_t i) { return encloses(areas_[i].region, cell.box); });
}

void AreaCells::make_leaf(const AreaCell& cell, std::uint32_t node, AreaIndex& index) {
    index.nodes[node] = {
        {}, 0, static_cast<std::uint32_t>(index.items.size()), static_cast<std::uint32_t>(cell.areas.size())};
    index.items.insert(index.items.end(), cell.areas.begin(), cell.areas.end());
}

AreaIndex AreaCells::build(AreaIndexKind kind) const {
    AreaIndex index{kind, std::vector<AreaNode>(1), {}};
    std::vector<AreaCell> cells{root_}; // by node
    const std::size_t most_entries = entries_of_few + entries_per_area * areas_.size();
    std::size_t entries = areas_.size();
    for (std::uint32_t node = 0; node < cells.size(); ++node) {
        const AreaCell cell = std::move(cells[node]);
        std::vector<Aabb> parts;
        AreaNode inner{};
        const bool may_split = entries < most_entries;
        if (may_split && kind == AreaIndexKind::octree && cell.level + 1 < octree_levels && !is_homogeneous(cell))
            parts = octants(cell, inner);
        if (may_split && kind == AreaIndexKind::kd) parts = halves(cell, inner);
        if (parts.empty()) {
            make_leaf(cell, node, index);
            continue;
        }
        inner.first = static_cast<std::uint32_t>(cells.size());
        inner.count = BOXWOOD_NONE;
        index.nodes[node] = inner;
        entries -= cell.areas.size();
        for (const Aabb& part : parts) {
            cells.push_back(child(cell, part));
            entries += cells.back().areas.size();
        }
        index.nodes.resize(cells.size());
    }
    return index;
}

std::vector<Aabb> AreaCells::octants(const AreaCell& cell, AreaNode& node) {
    node.axis = BOXWOOD_OCTANTS;
    for (int k = 0; k < 3; ++k) node.split[k] = 0.5f * cell.box.min[k] + 0.5f * cell.box.max[k];
    std::vector<Aabb> parts(8, cell.box);
    for (int i = 0; i < 8; ++i)
        for (int k = 0; k < 3; ++k) (i >> k & 1 ? parts[i].min[k] : parts[i].max[k]) = node.split[k];
    return parts;
}

AreaIndex build_area_index(std::span<const LocalArea> areas, AreaIndexKind kind) {
    if (kind == AreaIndexKind::automatic) kind = areas.size() <= most_in_list ? AreaIndexKind::list : AreaIndexKind::kd;
    if (areas.empty()) return {kind, {}, {}};
    return AreaCells(areas).build(kind);
}

std::vector<std::uint32_t> find_areas(const AreaIndex& index, std::span<const LocalArea> areas,
                                      const glm::vec3& point) {
    std::vector<std::uint32_t> found;
    if (index.nodes.empty()) return found;
    const AreaNode* node = index.nodes.data();
    while (node->count == BOXWOOD_NONE) {
        std::uint32_t side = 0;
        if (node->axis == BOXWOOD_OCTANTS)
            for (int k = 0; k < 3; ++k) side |= (point[k] >= node->split[k] ? 1u : 0u) << k;
        else
            side = point[static_cast<int>(node->axis)] >= node->split[node->axis] ? 1 : 0;
        node = &index.nodes[node->first + side];
    }
    for (std::uint32_t i = node->first; i < node->first + node->count; ++i)
        if (contains(areas[index.items[i]].region, point)) found.push_back(index.items[i]);
    return found;
}

} // namespace boxwood
