// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "hierarchy/forest.hpp"
#include "shared/instance.h"

namespace boxwood {

/// Metrics of one forest, per tree and in all.
struct ForestQuality {
    double sum_area = 0.0; ///< Surface area of all nodes' boxes.
    double sum_volume = 0.0;
    std::vector<double> root_area; ///< Per tree.
    std::vector<double> sah;       ///< Per tree: expected nodes and primitives tested by a ray that hits its root box.
    std::vector<double> inner_sah; ///< Per tree: the part of the inner nodes.
};

/// Waits. Sums are pairwise and in a fixed order. O(n).
ForestQuality measure(Device& device, const Forest& forest);

/// The SAH cost of two levels: top nodes, then each instance's bottom tree weighted by the chance to reach its box.
double two_level_sah(const ForestQuality& bottom, const ForestQuality& top, const std::vector<Aabb>& instance_boxes,
                     const std::vector<InstanceRecord>& instances);

} // namespace boxwood
