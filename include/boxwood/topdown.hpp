// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "boxwood/buffer.hpp"
#include "boxwood/topology.hpp"
#include "shared/aabb.h"
#include "shared/influence.h"

namespace boxwood {

/// How a top-down builder splits nodes (paper section 8, thesis 5.1). The strategy is OpenCL functions by name, the
/// caller's own in `source` (see CONTRIBUTING.md) or these, of cl/build/strategies.h and distribution.h:
/// - measures: surface_measure, of rays from everywhere; projected_measure, of the areas' rays; expected_measure, of
///   all;
/// - costs: measured_cost, of the primitives on both sides; overlap_cost, and of what the sides share;
/// - axes: longest_axes; facing_axes, those that the areas' rays see edge-on; round_robin_axes, by level; all_axes,
///   alike;
/// - stops: threshold_stop, by the max_leaf_ thresholds; never.
struct TopDownOptions {
    std::string measure = "surface_measure"; ///< Probability that a ray of the distribution meets a box.
    std::string cost = "measured_cost";      ///< Cost of a pair of children.
    std::string axes = "longest_axes";       ///< Quality of the three axes to split along; they are tried best first.
    std::string stop = "threshold_stop";     ///< Whether a node becomes a leaf.
    std::string fallback_measure = "surface_measure";
    std::string fallback_axes = "longest_axes";
    std::string source = {}; ///< OpenCL functions of the caller, compiled into the program before it needs them.

    std::uint32_t bins = 32; ///< Bins along an axis: 2 to 64.
    bool bin_box = false;    ///< Bins of the node's box (the paper's way), else the box of its primitives' centres.
    std::uint32_t primitives_per_bin = 16; ///< Without bin_box n primitives have at most 4 + n / this bins: 1 to 1000.
    std::uint32_t block_size =
        1; ///< Primitives that a leaf tests at once, 1 or 4: nodes of no more are not split by cost.

    // The paper's 8.1.1 and table 1.
    float max_leaf_cost = 0.0f;
    float max_leaf_area = 0.0f; ///< As a share of the tree's, by the measure.
    float max_leaf_hit_probability = 0.0f;
    std::uint32_t max_leaf_primitives = 1; ///< A node of at most so many is a leaf. The paper's experiments: 2.
    std::uint32_t max_levels = 100;        ///< Below, nodes are halved in the order they have: 1 to 1000.
    std::uint32_t max_non_fallback_levels = 100;
    float split_plane_quality = 0.4f; ///< [0, 1]: axes of less are not tried but for the fallback.
    float acceptable_children =
        1.3f; ///< Probabilities of the children over the parent's, below which no fallback is needed.
    float excellent_children = 0.0f; ///< Below which no more axes are tried; 0: all good axes are. The paper's: 0.9.
};

/// A topology with the leaves that the strategy chose; a node whose primitives no plane parts is one too.
struct TopDownTree {
    Topology topology; ///< Down to single primitives: below a chosen leaf ranges are halved.
    /// n, by inner node: 1 when the whole subtree is one leaf, or part of one; else 0, as in unused slots.
    Buffer<std::uint32_t> leaves;
    std::uint64_t splits = 0;     ///< Nodes that were split by the strategy.
    std::uint64_t axes_tried = 0; ///< Over those nodes.
    std::uint64_t fallbacks = 0;  ///< Of those nodes, split by the fallback.
};

/// Builds the trees over the primitives with the boxes `boxes`, tree t over [offsets[t], offsets[t + 1]), at least one,
/// top-down, level by level, all nodes of a level in the same launches. Primitives go left or right by `centres` (3
/// floats each; empty: the middles of their boxes). Boxes and centres within largest_coordinate of 0
/// (boxwood/scene.hpp), no box empty. The rays of tree t follow areas[area_starts[t], area_starts[t + 1]) by their
/// shares, the others are isotropic; no starts: no areas.
/// Deterministic: does not depend on how the work is cut. At most max_levels levels by the strategy, and as many below
/// as halving takes. O(n) work a level. Throws InputError for options out of range, CapacityError, and ProgramError for
/// a source that does not compile.
TopDownTree topdown(Device& device, BufferView<const Aabb> boxes, BufferView<const float> centres,
                    Buffer<std::uint32_t> offsets, BufferView<const InfluenceRecord> areas,
                    BufferView<const std::uint32_t> area_starts, const TopDownOptions& options);

} // namespace boxwood
