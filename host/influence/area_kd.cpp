// SPDX-License-Identifier: MIT
// Where the k-d tree over areas is split.
#include <algorithm>

#include "influence/area_cells.hpp"

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
    for (int axis = 0; axis < 3; ++axis) {
        const double low = cell.box.min[axis], high = cell.box.max[axis];
        std::vector<float> least, most; // sides of the boxes, sorted
        for (const std::uint32_t i : cell.areas) {
            least.push_back(areas_[i].box.min[axis]);
            most.push_back(areas_[i].box.max[axis]);
        }
        std::sort(least.begin(), least.end());
        std::sort(most.begin(), most.end());
        for (const std::vector<float>* sides : {&least, &most})
            for (const float split : *sides) {
                if (!(split > low && split < high)) continue;
                const double left = (split - low) / (high - low); // of points evenly spread
                const auto in_left = std::upper_bound(least.begin(), least.end(), split) - least.begin();
                const auto in_right = most.end() - std::lower_bound(most.begin(), most.end(), split);
                const double cost =
                    step_cost + left * static_cast<double>(in_left) + (1.0 - left) * static_cast<double>(in_right);
                if (cost >= best) continue;
                best = cost;
                found = true;
                node = {};
                node.axis = static_cast<std::uint32_t>(axis);
                node.split[axis] = split;
            }
    }
    if (!found) return {};
    std::vector<Aabb> parts(2, cell.box);
    parts[0].max[node.axis] = parts[1].min[node.axis] = node.split[node.axis];
    return parts;
}

} // namespace boxwood
