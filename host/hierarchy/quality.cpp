// SPDX-License-Identifier: MIT
#include "hierarchy/quality.hpp"

#include <algorithm>
#include <cmath>

#include "boxwood/reduce.hpp"
#include "boxwood/segmented_reduce.hpp"
#include "runtime/launch.hpp"

namespace boxwood {

namespace {

double surface_area(const Aabb& box) {
    const double x = static_cast<double>(box.max[0]) - box.min[0];
    const double y = static_cast<double>(box.max[1]) - box.min[1];
    const double z = static_cast<double>(box.max[2]) - box.min[2];
    return 2.0 * (x * y + y * z + z * x);
}

/// A power of two near the largest extent, so that scaling by it is exact.
float unit_of(const std::vector<Aabb>& boxes) {
    float largest = 0.0f;
    for (const Aabb& box : boxes)
        for (int k = 0; k < 3; ++k) largest = std::max(largest, box.max[k] - box.min[k]);
    return largest > 0.0f ? std::ldexp(1.0f, std::max(std::ilogb(largest), -100)) : 1.0f;
}

/// Sums of one half of the nodes (inner nodes or leaves), per tree.
struct HalfSums {
    std::vector<float> areas;
    std::vector<float> volumes;
};

HalfSums sum_half(Device& device, const Forest& forest, std::uint32_t first, float unit) {
    const auto count = static_cast<std::uint32_t>(forest.topology.size());
    const std::size_t trees = forest.topology.trees();
    const Buffer<float> areas = make_scratch<float>(device, count, "areas of nodes");
    const Buffer<float> volumes = make_scratch<float>(device, count, "volumes of nodes");
    launch(device, {"hierarchy/quality.cl", "node_measures"}, "node measures", count, forest.volumes, areas, volumes,
           unit, first, count);
    const Buffer<float> sums = make_scratch<float>(device, trees, "sums over trees");
    HalfSums result;
    segmented_reduce<float>(device, areas, forest.topology.offsets, Operator::sum, sums);
    result.areas = download(device, sums);
    segmented_reduce<float>(device, volumes, forest.topology.offsets, Operator::sum, sums);
    result.volumes = download(device, sums);
    return result;
}

} // namespace

ForestQuality measure(Device& device, const Forest& forest) {
    const Stage stage(device, "quality");
    const std::vector<Aabb> bounds = download(device, forest.tree_bounds);
    const float unit = unit_of(bounds);
    const double unit_area = std::pow(static_cast<double>(unit), 2), unit_volume = unit_area * unit;
    const HalfSums inner = sum_half(device, forest, 0, unit);
    const HalfSums leaves = sum_half(device, forest, static_cast<std::uint32_t>(forest.topology.size()), unit);

    ForestQuality quality;
    for (std::size_t tree = 0; tree < bounds.size(); ++tree) {
        const double inner_area = inner.areas[tree] * unit_area, leaf_area = leaves.areas[tree] * unit_area;
        const double root = surface_area(bounds[tree]);
        quality.sum_area += inner_area + leaf_area;
        quality.sum_volume += (static_cast<double>(inner.volumes[tree]) + leaves.volumes[tree]) * unit_volume;
        quality.root_area.push_back(root);
        // A tree whose box has no area is hit edge-on or not at all: every node of it counts as hit once.
        quality.inner_sah.push_back(root > 0.0 ? inner_area / root : 1.0);
        quality.sah.push_back(root > 0.0 ? (inner_area + leaf_area) / root : 1.0);
    }
    return quality;
}

double two_level_sah(const ForestQuality& bottom, const ForestQuality& top, const std::vector<Aabb>& instance_boxes,
                     const std::vector<InstanceRecord>& instances) {
    const double root = top.root_area[0];
    double cost = top.inner_sah[0];
    for (std::size_t i = 0; i < instances.size(); ++i)
        cost += (root > 0.0 ? surface_area(instance_boxes[i]) / root : 1.0) * bottom.sah[instances[i].mesh];
    return cost;
}

} // namespace boxwood
