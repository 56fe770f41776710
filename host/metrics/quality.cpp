// SPDX-License-Identifier: MIT
#include "metrics/quality.hpp"

#include <algorithm>
#include <cmath>

#include "boxwood/reduce.hpp"
#include "boxwood/segmented_reduce.hpp"
#include "runtime/launch.hpp"

namespace boxwood {

namespace {

/// Measures of one half of the nodes (inner nodes or leaves): each node's area, and sums per tree.
struct Half {
    Buffer<float> node_areas;
    std::vector<float> areas;
    std::vector<float> volumes;
    std::uint32_t fitted = 0; ///< Nodes that do not keep their AABB.
};

Half measure_half(Device& device, const BinaryTrees& trees, std::uint32_t first, float unit) {
    const auto count = static_cast<std::uint32_t>(trees.topology.size());
    Half half;
    half.node_areas = make_scratch<float>(device, count, "areas of nodes");
    Buffer<float> volumes = make_scratch<float>(device, count, "volumes of nodes");
    if (trees.boxes.size() == 0) {
        launch(device, {"metrics/quality.cl", "aabb_measures"}, "node measures", count, trees.volumes, half.node_areas,
               volumes, unit, first, count);
    } else {
        Buffer<std::uint32_t> fitted = make_scratch<std::uint32_t>(device, count, "fitted nodes");
        launch(device, {"metrics/quality.cl", "obb_measures"}, "node measures", count, trees.volumes, trees.boxes,
               half.node_areas, volumes, fitted, unit, first, count);
        Buffer<std::uint32_t> sum = make_scratch<std::uint32_t>(device, 1, "fitted nodes");
        reduce(device, fitted, Operator::sum, sum);
        half.fitted = download_element(device, sum, 0);
    }
    Buffer<float> sums = make_scratch<float>(device, trees.topology.trees(), "sums over trees");
    segmented_reduce(device, half.node_areas, trees.topology.offsets, Operator::sum, sums);
    half.areas = download(device, sums);
    segmented_reduce(device, volumes, trees.topology.offsets, Operator::sum, sums);
    half.volumes = download(device, sums);
    return half;
}

std::vector<float> root_areas(Device& device, const BinaryTrees& trees, const Half& inner, const Half& leaves) {
    const auto tree_count = static_cast<std::uint32_t>(trees.topology.trees());
    Buffer<float> roots = make_scratch<float>(device, tree_count, "areas of roots");
    launch(device, {"metrics/quality.cl", "root_areas"}, "root areas", tree_count, inner.node_areas, leaves.node_areas,
           trees.topology.offsets, roots, tree_count);
    return download(device, roots);
}

std::vector<double> areas_by_primitive(Device& device, const BinaryTrees& trees, const Half& leaves, double unit_area) {
    const std::vector<float> areas = download(device, leaves.node_areas);
    const std::vector<std::uint32_t> order = download(device, trees.topology.order);
    std::vector<double> result(areas.size());
    for (std::size_t position = 0; position < areas.size(); ++position)
        result[order[position]] = areas[position] * unit_area;
    return result;
}

} // namespace

float unit_of_lengths(Device& device, const BinaryTrees& trees) {
    float largest = 0.0f;
    for (const Aabb& box : download(device, trees.tree_bounds))
        for (int k = 0; k < 3; ++k) largest = std::max(largest, box.max[k] - box.min[k]);
    return largest > 0.0f ? std::ldexp(1.0f, std::max(std::ilogb(largest), -100)) : 1.0f;
}

TreeQuality measure(Device& device, const BinaryTrees& trees, bool leaf_areas) {
    const Stage stage(device, "quality");
    const float unit = unit_of_lengths(device, trees);
    const double unit_area = std::pow(static_cast<double>(unit), 2), unit_volume = unit_area * unit;
    const auto leaf_count = static_cast<std::uint32_t>(trees.topology.size());
    const Half inner = measure_half(device, trees, 0, unit);
    const Half leaves = measure_half(device, trees, leaf_count, unit);
    const std::vector<float> roots = root_areas(device, trees, inner, leaves);

    TreeQuality quality;
    quality.nodes = std::uint64_t{2} * leaf_count - roots.size();
    quality.sums.obb_smaller_fraction =
        (static_cast<double>(inner.fitted) + leaves.fitted) / static_cast<double>(quality.nodes);
    for (std::size_t tree = 0; tree < roots.size(); ++tree) {
        const double inner_area = inner.areas[tree], area = inner_area + leaves.areas[tree], root = roots[tree];
        quality.sums.sum_area += area * unit_area;
        quality.sums.sum_volume += (static_cast<double>(inner.volumes[tree]) + leaves.volumes[tree]) * unit_volume;
        quality.root_area.push_back(root * unit_area);
        // A tree whose box has no area is hit edge-on or not at all: every node of it counts as hit once.
        quality.inner_sah.push_back(root > 0.0 ? inner_area / root : 1.0);
        quality.sah.push_back(root > 0.0 ? area / root : 1.0);
    }
    if (leaf_areas) quality.leaf_area = areas_by_primitive(device, trees, leaves, unit_area);
    return quality;
}

LevelQuality total(const TreeQuality& bottom, const TreeQuality& top) {
    const auto b = static_cast<double>(bottom.nodes), t = static_cast<double>(top.nodes);
    return {bottom.sums.sum_volume + top.sums.sum_volume, bottom.sums.sum_area + top.sums.sum_area,
            (bottom.sums.obb_smaller_fraction * b + top.sums.obb_smaller_fraction * t) / (b + t)};
}

double two_level_sah(const TreeQuality& bottom, const TreeQuality& top, const std::vector<InstanceRecord>& instances) {
    const double root = top.root_area[0];
    double cost = top.inner_sah[0];
    for (std::size_t i = 0; i < instances.size(); ++i)
        cost += (root > 0.0 ? top.leaf_area[i] / root : 1.0) * bottom.sah[instances[i].mesh];
    return cost;
}

} // namespace boxwood
