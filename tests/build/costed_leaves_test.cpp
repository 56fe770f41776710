// SPDX-License-Identifier: MIT
// Leaves by cost, against a plain recursion in double precision with the probabilities of the analyser.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "boxwood/analysis.hpp"
#include "boxwood/costed_leaves.hpp"
#include "build/built_trees.hpp"
#include "tuning.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("build");

namespace {

constexpr double box_cost = 1.0, primitive_cost = 1.2;

InfluenceRecord plane_area(float share) {
    InfluenceRecord area{};
    area.origin[2] = 20.0f;
    area.right[0] = area.up[1] = 1.0f;
    area.forward[2] = -1.0f;
    area.half_width = area.half_height = 4.0f;
    area.far = 40.0f;
    area.share = share;
    return area;
}

InfluenceRecord point_area(float share) {
    InfluenceRecord area = plane_area(share);
    area.point = 1;
    area.near = 1.0f;
    area.half_width = area.half_height = 0.5f;
    return area;
}

/// One tree of a forest on the host.
struct Reference {
    const HostTopology& topology;
    const std::vector<std::uint32_t>& leaves;
    AnalysisTree tree;
    std::vector<double> probabilities; ///< By node of `tree`.
    int wrong = 0, leaf_count = 0, split_count = 0;

    Reference(const BuiltTrees& built, const std::vector<std::uint32_t>& marks, std::uint32_t which,
              const std::vector<InfluenceRecord>& areas)
        : topology(built.topology), leaves(marks),
          tree(analysis_tree(test_device(), built.trees.topology, built.trees.volumes, {}, which)) {
        double isotropic = 1.0;
        probabilities.assign(tree.nodes.size(), 0.0);
        for (InfluenceRecord area : areas) {
            const double share = area.share;
            isotropic -= share;
            area.share = 1.0f;
            const std::vector<NodeMeasures> measures = measure_nodes(tree, std::vector{area});
            for (std::size_t i = 0; i < probabilities.size(); ++i)
                probabilities[i] += share * measures[i].probability_culled;
        }
        const std::vector<NodeMeasures> measures = measure_nodes(tree, {});
        for (std::size_t i = 0; i < probabilities.size(); ++i) probabilities[i] += isotropic * measures[i].surface;
        cost(topology.root(which), 0);
    }

    double whole_cost(std::uint32_t node, std::uint32_t own) const {
        const Span span = span_of(topology, node);
        return primitive_cost * probabilities[own] * (span.last - span.first + 1);
    }

    /// What each choice of leaves below a node costs.
    std::vector<double> every_cost(std::uint32_t node, std::uint32_t own) const {
        std::vector<double> costs{whole_cost(node, own)};
        if (node >= topology.size()) return costs;
        const std::uint32_t below = tree.nodes[own].first_child;
        const std::vector<double> rights = every_cost(topology.children[node].s[1], below + 1);
        for (const double left : every_cost(topology.children[node].s[0], below))
            for (const double right : rights) costs.push_back(2.0 * box_cost * probabilities[own] + left + right);
        return costs;
    }

    /// That of the marks.
    double marked_cost(std::uint32_t node, std::uint32_t own) const {
        if (node >= topology.size() || leaves[node] == 1) return whole_cost(node, own);
        const std::uint32_t below = tree.nodes[own].first_child;
        return 2.0 * box_cost * probabilities[own] + marked_cost(topology.children[node].s[0], below) +
               marked_cost(topology.children[node].s[1], below + 1);
    }

    /// The cheaper cost of what is below a node; compares the device's choice where it is not within roundings.
    double cost(std::uint32_t node, std::uint32_t own) {
        if (node >= topology.size()) return primitive_cost * probabilities[own];
        const double left = cost(topology.children[node].s[0], tree.nodes[own].first_child);
        const double right = cost(topology.children[node].s[1], tree.nodes[own].first_child + 1);
        const double whole = whole_cost(node, own);
        const double split = 2.0 * box_cost * probabilities[own] + left + right;
        const bool leaf = whole <= split;
        const bool tie =
            std::abs(whole - split) <= 1e-4 * whole; // probabilities are good to 1e-5, see projected_area.h
        if (!tie && (leaves[node] == 1) != leaf) ++wrong;
        ++(leaf ? leaf_count : split_count);
        return std::min(whole, split);
    }
};

} // namespace

TEST_CASE("costed_leaves: a subtree is one leaf where that costs less") {
    Device& device = test_device();
    const std::uint32_t large = small_sizes() ? 60 : 900;
    const BuiltTrees built =
        build_trees_of(device, scene_of({random_mesh(large, 5.0f, 0.5f, 1), random_mesh(1, 1.0f, 1.0f, 2),
                                         random_mesh(large / 2, 5.0f, 0.5f, 3), random_mesh(2, 5.0f, 0.5f, 4)}));
    const std::vector<InfluenceRecord> areas{plane_area(0.5f), point_area(0.25f), plane_area(1.0f)};
    const std::vector<std::uint32_t> starts{0, 0, 0, 2, 3};
    const Buffer<InfluenceRecord> area_buffer = upload(device, areas, "areas");
    const Buffer<std::uint32_t> start_buffer = upload(device, starts, "starts");
    for (const Tuning& tuning : tunings()) {
        const TuningScope scope(tuning);
        const Buffer<std::uint32_t> marks = costed_leaves(device, built.trees.topology, built.trees.volumes,
                                                          built.trees.tree_bounds, area_buffer, start_buffer);
        const std::vector<std::uint32_t> leaves = download(device, marks);
        for (std::uint32_t t = 0; t < 4; ++t) {
            CAPTURE(t);
            const Reference reference(built, leaves, t, {areas.begin() + starts[t], areas.begin() + starts[t + 1]});
            CHECK(reference.wrong == 0);
            if (t == 1 || t == 3) continue; // one node at most
            CHECK(reference.split_count > 0);
            CHECK(reference.leaf_count > 0);
        }
        // Slots without a node are no leaves.
        for (std::uint32_t t = 0; t < 4; ++t) CHECK(leaves[built.topology.offsets[t + 1] - 1] == 0);
    }
}

TEST_CASE("costed_leaves: no trees have no leaves") {
    Device& device = test_device();
    Topology none;
    none.offsets = upload(device, std::vector{0u}, "offsets");
    CHECK(costed_leaves(device, none, {}, {}, {}, upload(device, std::vector{0u}, "starts")).size() == 0);
}

TEST_CASE("costed_leaves: no other choice of leaves costs less") {
    // 16 triangles: up to some hundred choices for a tree in balance; in crowds, so that leaves of all sizes are best.
    Device& device = test_device();
    int several = 0;
    for (std::uint64_t salt = 0; salt < (small_sizes() ? 2 : 30); ++salt) {
        const float size = std::exp2(static_cast<float>(salt % 6) - 3.0f);
        const BuiltTrees built = build_trees_of(device, scene_of({random_mesh(16, 3.0f, size, salt)}));
        const std::vector<InfluenceRecord> areas{plane_area(0.5f), point_area(0.25f)};
        const std::vector<std::uint32_t> leaves = download(
            device, costed_leaves(device, built.trees.topology, built.trees.volumes, built.trees.tree_bounds,
                                  upload(device, areas, "areas"), upload(device, std::vector{0u, 2u}, "starts")));
        const Reference reference(built, leaves, 0, areas);
        const std::vector<double> costs = reference.every_cost(0, 0);
        const auto [least, most] = std::minmax_element(costs.begin(), costs.end());
        CHECK(reference.marked_cost(0, 0) <= *least * (1.0 + 1e-4)); // as above
        several += leaves[0] == 0 && *least < 0.99 * *most ? 1 : 0;
    }
    CHECK(several > 0);
}

TEST_SUITE_END();
