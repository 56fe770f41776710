// SPDX-License-Identifier: MIT
#include "boxwood/analysis.hpp"

#include <algorithm>

#include "influence/projection.hpp"

namespace boxwood {

namespace {

using Corners = std::array<glm::dvec3, 8>;

Corners corners_of(const AnalysisTree& tree, std::uint32_t node) {
    Corners corners;
    for (int i = 0; i < 8; ++i) {
        if (!tree.corners.empty()) {
            corners[i] = tree.corners[node][i];
            continue;
        }
        const Aabb& box = tree.nodes[node].box;
        for (int k = 0; k < 3; ++k) corners[i][k] = i >> k & 1 ? box.max[k] : box.min[k];
    }
    return corners;
}

double surface(const Corners& corners) {
    const glm::dvec3 x = corners[1] - corners[0], y = corners[2] - corners[0], z = corners[4] - corners[0];
    return 2.0 * (glm::length(glm::cross(x, y)) + glm::length(glm::cross(y, z)) + glm::length(glm::cross(z, x)));
}

/// The projections of one node's box, and its shares of the rectangle.
struct Shadow {
    Polygon all;
    Polygon culled;
    double probability = 0.0;
    double probability_culled = 0.0;

    Shadow(const InfluenceRecord& area, const Corners& corners)
        : all(projection(area, corners)), culled(clip_to_rectangle(all)), probability(all.area() / 4.0),
          probability_culled(culled.area() / 4.0) {}
};

void add_probabilities(const Shadow& shadow, double weight, NodeMeasures& measures) {
    measures.probability += weight * shadow.probability;
    measures.probability_culled += weight * shadow.probability_culled;
}

/// The overlap of each two of the node's children; `shadows` are theirs.
void add_overlaps(std::span<const Shadow> shadows, double weight, NodeMeasures& measures) {
    for (std::size_t i = 0; i < shadows.size(); ++i) {
        for (std::size_t j = i + 1; j < shadows.size(); ++j) {
            const Shadow &a = shadows[i], &b = shadows[j];
            measures.overlap += weight * intersection(a.all, b.all).area() / 4.0;
            measures.overlap_culled += weight * intersection(a.culled, b.culled).area() / 4.0;
            measures.smaller += weight * std::min(a.probability, b.probability);
            measures.smaller_culled += weight * std::min(a.probability_culled, b.probability_culled);
        }
    }
}

/// Adds what one area says to the measures of all nodes: each node is projected once, by its parent.
void add_area(const AnalysisTree& tree, const InfluenceRecord& area, double weight,
              std::vector<NodeMeasures>& measures) {
    add_probabilities(Shadow(area, corners_of(tree, 0)), weight, measures[0]);
    std::vector<Shadow> shadows;
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
        const AnalysisNode& node = tree.nodes[i];
        shadows.clear();
        for (std::uint32_t child = node.first_child; child < node.first_child + node.children; ++child) {
            shadows.emplace_back(area, corners_of(tree, child));
            add_probabilities(shadows.back(), weight, measures[child]);
        }
        add_overlaps(shadows, weight, measures[i]);
    }
}

/// What a node charges whoever meets it.
double cost_of(const AnalysisNode& node) {
    return node.children == 0 ? primitive_cost * node.primitives : box_cost * node.children;
}

/// The figures that a node adds to its level, but for the overlap with its siblings.
LevelFigures figures_of(const AnalysisNode& node, const NodeMeasures& measured) {
    const double cost = cost_of(node);
    LevelFigures figures;
    figures.nodes = 1;
    figures.leaves = node.children == 0 ? 1 : 0;
    figures.sah = cost * measured.surface;
    figures.pah = cost * measured.probability;
    figures.pah_culled = cost * measured.probability_culled;
    return figures;
}

LevelFigures overlap_of(const NodeMeasures& parent) {
    LevelFigures figures;
    figures.overlap = parent.overlap;
    figures.overlap_culled = parent.overlap_culled;
    figures.smaller = parent.smaller;
    figures.smaller_culled = parent.smaller_culled;
    return figures;
}

} // namespace

std::vector<NodeMeasures> measure_nodes(const AnalysisTree& tree, std::span<const InfluenceRecord> areas) {
    std::vector<NodeMeasures> measures(tree.nodes.size());
    if (measures.empty()) return measures;
    // A tree whose box has no area is met edge-on or not at all: every node of it counts as met.
    const double root = surface(corners_of(tree, 0));
    for (std::uint32_t i = 0; i < measures.size(); ++i)
        measures[i].surface = root > 0.0 ? surface(corners_of(tree, i)) / root : 1.0;
    double shares = 0.0;
    for (const InfluenceRecord& area : areas) shares += area.share;
    const double even = 1.0 / static_cast<double>(areas.size());
    for (const InfluenceRecord& area : areas) add_area(tree, area, shares > 0.0 ? area.share / shares : even, measures);
    return measures;
}

LevelFigures& LevelFigures::operator+=(const LevelFigures& other) {
    nodes += other.nodes;
    leaves += other.leaves;
    sah += other.sah;
    pah += other.pah;
    pah_culled += other.pah_culled;
    overlap += other.overlap;
    overlap_culled += other.overlap_culled;
    smaller += other.smaller;
    smaller_culled += other.smaller_culled;
    return *this;
}

LevelFigures Analysis::down_to(std::uint32_t level) const {
    LevelFigures sum;
    for (std::size_t i = 0; i < levels.size() && i <= level; ++i) sum += levels[i];
    return sum;
}

Analysis analysis_of(const AnalysisTree& tree, std::span<const NodeMeasures> measures) {
    Analysis start;
    start.levels.resize(tree.nodes.empty() ? 0 : tree.nodes.back().level + 1);
    const auto per_node = [&](const NodeView& node, Analysis& sums) {
        const NodeMeasures& measured = measures[node.index];
        sums.levels[node.level()] += figures_of(node.node(), measured);
        if (!node.is_leaf()) {
            sums.levels[node.level() + 1] += overlap_of(measured);
            return;
        }
        sums.primitives += node.primitives();
        if (node.primitives() >= sums.leaves_by_size.size()) sums.leaves_by_size.resize(node.primitives() + 1);
        ++sums.leaves_by_size[node.primitives()];
    };
    return analyze(tree, std::move(start), per_node, [](Analysis& sums) {
        for (const LevelFigures& level : sums.levels) sums.all += level;
        return std::move(sums);
    });
}

} // namespace boxwood
