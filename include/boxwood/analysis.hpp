// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "boxwood/topology.hpp"
#include "boxwood/tree_image.hpp"
#include "shared/aabb.h"
#include "shared/influence.h"

namespace boxwood {

/// What cost functions charge: the test of a child's box at an inner node that is met, and of a primitive of a leaf
/// that is met (paper 9.1: 2 boxes of cost 1 in a binary node).
inline constexpr double box_cost = 1.0;
inline constexpr double primitive_cost = 1.2;

/// A node of a tree of any layout; a leaf has no children.
struct AnalysisNode {
    Aabb box;                      ///< Of an oriented box its axis-aligned hull.
    std::uint32_t level = 0;       ///< The root has 0.
    std::uint32_t parent = 0;      ///< BOXWOOD_NONE for the root.
    std::uint32_t first_child = 0; ///< Children are consecutive.
    std::uint32_t children = 0;
    std::uint32_t primitives = 0; ///< Below the node.
};

/// A tree on the host, breadth first: the root first, levels ascending.
struct AnalysisTree {
    std::string name;
    std::vector<AnalysisNode> nodes;
    /// By node the corners of its box (bit k of the index: which end of axis k), where boxes are oriented; else empty.
    std::vector<std::array<glm::vec3, 8>> corners;
};

/// Tree `tree` of those with the boxes `volumes` (as from aabb_volumes), down to the marked `leaves` (as in
/// TopDownTree), to single primitives without any. A tree over no primitives, or that is not among them, has no nodes.
/// Waits. O(nodes of all trees).
AnalysisTree analysis_tree(Device& device, const Topology& topology, BufferView<const Aabb> volumes,
                           BufferView<const std::uint32_t> leaves = {}, std::size_t tree = 0);

/// The trees of a valid image as they are stored: with two levels the tree over instances, then that of each mesh that
/// has an instance, in object space; else the one over everything ("tree"), then the local tree of each of image.areas
/// ("local tree I"), in world space. A child of a wide8 node is one level deeper. A root's box, which no layout stores,
/// is the axis-aligned hull of its children's. An empty tree gives none.
std::vector<AnalysisTree> analysis_trees(const TreeImage& image, const Scene& scene);

/// The rays of each of image.areas, as the builders of the local trees knew them: those of point areas begin at their
/// near plane.
std::vector<InfluenceRecord> stored_areas(const TreeImage& image);

/// A node as functions of the caller see it.
struct NodeView {
    const AnalysisTree& tree;
    std::uint32_t index = 0;

    const AnalysisNode& node() const { return tree.nodes[index]; }
    const Aabb& box() const { return node().box; }
    std::uint32_t level() const { return node().level; }
    std::uint32_t primitives() const { return node().primitives; }
    bool is_leaf() const { return node().children == 0; }
    bool is_root() const { return index == 0; }
    std::uint32_t children() const { return node().children; }
    NodeView child(std::uint32_t which) const { return {tree, node().first_child + which}; }
    NodeView parent() const { return {tree, node().parent}; } ///< Not of the root.
};

/// Calls per_node(NodeView, Data&) for every node, breadth first, then final_action(Data&), whose result is returned:
/// any figure of a tree can be gathered so (thesis 5.2).
template <class Data, class PerNode, class Final>
auto analyze(const AnalysisTree& tree, Data data, PerNode&& per_node, Final&& final_action) {
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) per_node(NodeView{tree, i}, data);
    return std::forward<Final>(final_action)(data);
}

/// Figures of one node, in double precision. Probabilities are those that a ray of the areas meets the box, by their
/// shares: the box's projection (paper section 5; what lies before the rectangle that rays leave is cut off) over that
/// rectangle. Culled, only what projects into the rectangle counts, which is the probability exactly; else it may pass
/// 1. Overlaps are of the projections of each two of the node's children, in the same unit, `smaller` the smaller of
/// the two, each summed over pairs.
struct NodeMeasures {
    double surface = 0.0; ///< The probability that an isotropic ray that meets the root does: surface over the root's.
    double probability = 0.0;
    double probability_culled = 0.0;
    double overlap = 0.0;
    double overlap_culled = 0.0;
    double smaller = 0.0;
    double smaller_culled = 0.0;
};

/// By node. Areas without shares count alike; without areas all but the surface is zero. O(nodes areas).
std::vector<NodeMeasures> measure_nodes(const AnalysisTree& tree, std::span<const InfluenceRecord> areas);

/// Sums over the nodes of one level, or of several.
struct LevelFigures {
    std::uint64_t nodes = 0;
    std::uint64_t leaves = 0;
    double sah = 0.0; ///< Expected cost of an isotropic ray that meets the root.
    double pah = 0.0; ///< Expected cost of a ray of the areas, whether it meets the root or not.
    double pah_culled = 0.0;
    double overlap = 0.0; ///< Of siblings on this level, as in NodeMeasures of their parents.
    double overlap_culled = 0.0;
    double smaller = 0.0;
    double smaller_culled = 0.0;

    LevelFigures& operator+=(const LevelFigures& other);
    /// Overlaps over smaller projections (paper 9.4.1), 0 where those have no area.
    double overlap_ratio() const { return smaller > 0.0 ? overlap / smaller : 0.0; }
    double overlap_ratio_culled() const { return smaller_culled > 0.0 ? overlap_culled / smaller_culled : 0.0; }
};

/// The levels down to which the paper measures overlap; the last is all.
inline constexpr std::uint32_t overlap_levels[] = {4, 7, 10, 15, std::numeric_limits<std::uint32_t>::max()};

/// Figures of a whole tree.
struct Analysis {
    std::vector<LevelFigures> levels; ///< By level, the root's first.
    LevelFigures all;
    std::uint64_t primitives = 0;
    std::vector<std::uint64_t> leaves_by_size; ///< leaves_by_size[n]: leaves of n primitives.

    std::uint32_t depth() const { return levels.empty() ? 0 : static_cast<std::uint32_t>(levels.size() - 1); }
    /// Sums over the levels 0 to `level`.
    LevelFigures down_to(std::uint32_t level) const;
};

/// `measures` as from measure_nodes over the same tree.
Analysis analysis_of(const AnalysisTree& tree, std::span<const NodeMeasures> measures);

} // namespace boxwood
