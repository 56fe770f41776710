// SPDX-License-Identifier: MIT
// Forests of boxes, and a top-down build of them against the recursion on the host, for the tests of the builder.
#pragma once

#include <doctest/doctest.h>

#include <cmath>

#include "boxwood/topdown.hpp"
#include "oracles/reference_topdown.hpp"
#include "support.hpp"

namespace boxwood::test {

struct Result {
    HostTopology topology;
    std::vector<std::uint32_t> leaves;
    std::uint64_t splits, axes_tried, fallbacks;
};

struct Boxes {
    std::vector<Aabb> boxes;
    std::vector<std::uint32_t> offsets{0};
    std::vector<float> centres; ///< Empty: the middles of the boxes.
};

inline Result run(const Boxes& forest, const TopDownOptions& options, const std::vector<InfluenceRecord>& areas = {},
                  const std::vector<std::uint32_t>& area_starts = {}) {
    Device& device = test_device();
    const Buffer<Aabb> boxes = upload(device, forest.boxes, "boxes");
    const Buffer<float> centres = upload(device, forest.centres, "centres");
    const Buffer<InfluenceRecord> records = upload(device, areas, "areas");
    const Buffer<std::uint32_t> starts = upload(device, area_starts, "area starts");
    const TopDownTree tree =
        topdown(device, boxes, centres, upload(device, forest.offsets, "offsets"), records, starts, options);
    return {to_host(device, tree.topology), download(device, tree.leaves), tree.splits, tree.axes_tried,
            tree.fallbacks};
}

/// Boxes of triangles spread in a cube, or in a plane, or on few places.
enum class Spread { cube, plane, line, places, sizes };

inline Boxes random_boxes(const std::vector<std::uint32_t>& sizes, Spread spread, std::uint64_t salt) {
    Random random(salt);
    Boxes forest;
    for (const std::uint32_t size : sizes) {
        for (std::uint32_t i = 0; i < size; ++i) {
            Aabb box;
            const float half = spread == Spread::sizes ? std::exp2(random.uniform(-12.0f, 2.0f)) : 0.02f;
            for (int k = 0; k < 3; ++k) {
                float place = random.uniform(-1.0f, 1.0f), extent = random.uniform(0.0f, half);
                if (spread == Spread::places) place = std::floor(2.0f * place), extent = 0.25f;
                const bool flat = (spread == Spread::plane && k == 1) || (spread == Spread::line && k != 2);
                if (flat) place = 0.5f, extent = 0.0f;
                box.min[k] = place - extent;
                box.max[k] = place + extent;
            }
            forest.boxes.push_back(box);
        }
        forest.offsets.push_back(static_cast<std::uint32_t>(forest.boxes.size()));
    }
    return forest;
}

inline Boxes scaled(Boxes forest, float factor) {
    for (Aabb& box : forest.boxes)
        for (int k = 0; k < 3; ++k) box.min[k] *= factor, box.max[k] *= factor;
    return forest;
}

/// The same trees as recursion gives, node by node, and the same counts.
inline void check(const Boxes& forest, const TopDownOptions& options, const ReferenceRules& rules) {
    const Result result = run(forest, options);
    const ReferenceTree wanted = reference_topdown(forest.boxes, forest.centres, forest.offsets, options, rules);
    CHECK(difference(result.topology, wanted.topology) == "");
    CHECK(result.leaves == wanted.leaves);
    CHECK(result.splits == wanted.splits);
    CHECK(result.axes_tried == wanted.axes_tried);
    CHECK(result.fallbacks == wanted.fallbacks);
}

inline TopDownOptions quality_options(std::uint32_t block) {
    TopDownOptions options;
    options.axes = "all_axes";
    options.stop = "never";
    options.block_size = block;
    return options;
}

inline ReferenceRules quality_rules() {
    ReferenceRules rules = reference_rules();
    rules.axes = reference_all;
    rules.thresholds = false;
    return rules;
}

inline std::uint32_t many() { return small_sizes() ? 150 : 3000; }

} // namespace boxwood::test
