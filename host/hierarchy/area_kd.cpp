// SPDX-License-Identifier: MIT
// Where the k-d tree over areas is split.
#include <algorithm>

#include "hierarchy/area_cells.hpp"

namespace boxwood {

namespace {

/// Going down one node costs as much as trying the box of an area.
constexpr double step_cost = 1.0;
constexpr std::uint32_t most_levels = 16;

} // namespace

std::vector<Aabb> AreaCells::halves(const AreaCell& cell, AreaNode& node) const {
    if (cell.level + 1 >= most_levels) return {};
    auto best = static_cast<double>(cell.areas.size());
    bool found = false;
    const auto consider = [&](int axis, float split) {
        const double low = cell.box.min[axis], high = cell.box.max[axis];
        if (!(split > low && split < high)) return;
        const double left = (split - low) / (high - low); // of points evenly spread
        double cost = step_cost;
        for (const std::uint32_t i : cell.areas) {
            if (areas_[i].box.min[axis] <= split) cost += left;
            if (areas_[i].box.max[axis] >= split) cost += 1.0 - left;
        }
        if (cost >= best) return;
        best = cost;
        found = true;
        node = {};
        node.axis = static_cast<std::uint32_t>(axis);
        node.split[axis] = split;
    };
    for (const std::uint32_t i : cell.areas) {
        for (int axis = 0; axis < 3; ++axis) {
            consider(axis, areas_[i].box.min[axis]);
            consider(axis, areas_[i].box.max[axis]);
        }
    }
    if (!found) return {};
    std::vector<Aabb> parts(2, cell.box);
    parts[0].max[node.axis] = parts[1].min[node.axis] = node.split[node.axis];
    return parts;
}

} // namespace boxwood
