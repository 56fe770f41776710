// SPDX-License-Identifier: MIT
#pragma once

namespace boxwood {

/// Sums over the boxes of all binary nodes of one level, leaves included.
struct LevelQuality {
    double sum_volume = 0.0;
    double sum_area = 0.0;
    double obb_smaller_fraction = 0.0; ///< Share of the nodes that do not keep their AABB.
};

} // namespace boxwood
