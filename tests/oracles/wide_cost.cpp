// SPDX-License-Identifier: MIT
#include "oracles/wide_cost.hpp"

#include <algorithm>
#include <map>

namespace boxwood::test {

namespace {

struct Search {
    const HostTopology& topology;
    const std::vector<Aabb>& volumes;
    CostModel model;
    std::map<std::uint32_t, double> known; ///< Cost of a binary node as one box, times its area.

    double area(std::uint32_t node) const { return area_of(volumes[node]); }
    bool is_leaf(std::uint32_t node) const {
        const Span span = span_of(topology, node);
        return span.last - span.first < model.leaf_size;
    }

    /// The least sum over the covers that keep the nodes of `chosen` and part any of `open` further.
    double best_cover(std::vector<std::uint32_t> open, std::size_t chosen, double cost) {
        if (open.empty()) return cost;
        const std::uint32_t node = open.back();
        open.pop_back();
        double best = best_cover(open, chosen + 1, cost + as_box(node));
        if (!is_leaf(node) && chosen + open.size() + 2 <= 8) {
            open.push_back(topology.children[node].s[0]);
            open.push_back(topology.children[node].s[1]);
            best = std::min(best, best_cover(open, chosen, cost));
        }
        return best;
    }

    /// `node` as a wide node, times its area.
    double as_node(std::uint32_t node) {
        return model.node * area(node) +
               best_cover({topology.children[node].s[0], topology.children[node].s[1]}, 0, 0.0);
    }

    double as_box(std::uint32_t node) {
        if (const auto found = known.find(node); found != known.end()) return found->second;
        const double best = is_leaf(node) ? model.leaf * area(node) : as_node(node);
        return known[node] = best;
    }
};

} // namespace

double area_of(const Aabb& box) {
    const double x = double(box.max[0]) - box.min[0], y = double(box.max[1]) - box.min[1];
    const double z = double(box.max[2]) - box.min[2];
    return 2.0 * (x * y + y * z + z * x);
}

double least_cost(const HostTopology& topology, const std::vector<Aabb>& volumes, std::uint32_t tree, CostModel model) {
    Search search{topology, volumes, model, {}};
    const std::uint32_t root = topology.root(tree);
    // The root is a wide node whatever it costs.
    const double best = search.is_leaf(root) ? (model.node + model.leaf) * search.area(root) : search.as_node(root);
    return best / search.area(root);
}

} // namespace boxwood::test
