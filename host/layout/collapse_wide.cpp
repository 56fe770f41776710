// SPDX-License-Identifier: MIT
#include <utility>
#include <vector>

#include "boxwood/collapse.hpp"
#include "boxwood/scan.hpp"
#include "runtime/launch.hpp"

namespace boxwood {

namespace {

/// Children chosen for the wide nodes of one level, before they are written.
struct Level {
    std::uint32_t size = 0;
    std::uint32_t leaves = 0;
    Buffer<std::uint32_t> children; ///< 8 per node
    /// Exclusive scan of how many inner children and, in the upper half, leaves each node has; the last of size + 1
    /// entries is the total.
    Buffer<std::uint64_t> starts;
    Buffer<std::uint32_t> leaf_sources; ///< The leaves as binary nodes.
};

struct Collapse {
    Device& device;
    const Topology& topology;
    BufferView<const Aabb> volumes;
    const Geometry* geometry; ///< null for trees over instances
    BufferView<const std::uint32_t> names;
    Buffer<std::uint32_t> plans;
    std::uint32_t count = static_cast<std::uint32_t>(topology.size());

    KernelRef kernel(const char* name) const {
        return {"layout/collapse_wide.cl",
                name,
                {{"TRIANGLE_LEAVES", geometry ? "1" : "0"}, {"NAMED", names.size() > 0 ? "1" : "0"}}};
    }

    /// Testing a block of four triangles takes about as long as testing eight boxes; an instance stands for a tree.
    Defines cost_model() const {
        return {{"LEAF_SIZE", geometry ? "4" : "1"}, {"NODE_COST", "1.0f"}, {"LEAF_COST", geometry ? "1.0f" : "4.0f"}};
    }
};

/// The choices of cl/layout/plan.h for every inner node.
Buffer<std::uint32_t> plan_collapse(const Collapse& c) {
    Buffer<std::uint32_t> plans = make_scratch<std::uint32_t>(c.device, c.count, "collapse choices");
    Buffer<float> costs = make_scratch<float>(c.device, 8 * static_cast<std::size_t>(c.count), "collapse costs");
    Buffer<std::uint32_t> arrivals = make_scratch<std::uint32_t>(c.device, c.count, "arrivals at splits");
    fill(c.device, arrivals, 0);
    const Slices slices = cut(c.device, c.count);
    launch(c.device, {"layout/collapse_cost.cl", "collapse_cost", c.cost_model()}, "collapse costs", slices.slices,
           c.volumes, c.topology.children, c.topology.parents, c.topology.far_ends, arrivals, costs, plans, c.count,
           slices.length);
    return plans;
}

/// The binary nodes that become the wide roots: the root of tree t, or its leaf if that is all.
Buffer<std::uint32_t> roots(const Collapse& c) {
    const auto trees = static_cast<std::uint32_t>(c.topology.trees());
    Buffer<std::uint32_t> sources = make_scratch<std::uint32_t>(c.device, trees, "wide roots");
    launch(c.device, c.kernel("root_sources"), "wide roots", trees, c.topology.offsets, sources, trees, c.count);
    return sources;
}

Level choose_children(const Collapse& c, BufferView<const std::uint32_t> sources) {
    Level level;
    level.size = static_cast<std::uint32_t>(sources.size());
    level.children = make_scratch<std::uint32_t>(c.device, 8 * sources.size(), "children of a level");
    level.starts = make_scratch<std::uint64_t>(c.device, sources.size() + 1, "children of a level");
    const Slices slices = cut(c.device, level.size);
    launch(c.device, c.kernel("choose_children"), "choose children", slices.slices, c.topology.children, c.plans,
           sources, level.children, level.starts, c.count, level.size, slices.length);
    exclusive_scan(c.device, level.starts, Operator::sum, level.starts);
    return level;
}

/// Every level from the roots down. Waits once per level for the size of the next.
std::vector<Level> choose_levels(const Collapse& c) {
    std::vector<Level> levels;
    Buffer<std::uint32_t> sources = roots(c);
    while (sources.size() > 0) {
        levels.push_back(choose_children(c, sources));
        Level& level = levels.back();
        const std::uint64_t totals = download_element(c.device, level.starts, level.size);
        level.leaves = static_cast<std::uint32_t>(totals >> 32);
        level.leaf_sources = make_scratch<std::uint32_t>(c.device, level.leaves, "leaves of a level");
        sources = make_scratch<std::uint32_t>(c.device, static_cast<std::uint32_t>(totals), "sources of a level");
        const Slices slices = cut(c.device, level.size);
        launch(c.device, c.kernel("partition_children"), "partition children", slices.slices, level.children,
               level.starts, sources, level.leaf_sources, level.size, slices.length);
    }
    return levels;
}

void write_levels(const Collapse& c, const std::vector<Level>& levels, WideLayout& layout) {
    std::uint32_t first_node = 0, first_leaf = 0;
    for (const Level& level : levels) {
        const Slices nodes = cut(c.device, level.size);
        launch(c.device, c.kernel("write_nodes"), "wide nodes", nodes.slices, c.volumes, c.topology.order,
               level.children, level.starts, layout.nodes, c.count, first_node, first_leaf, level.size, nodes.length);
        if (c.geometry) {
            const Slices leaves = cut(c.device, level.leaves);
            launch(c.device, c.kernel("write_blocks"), "triangle blocks", leaves.slices, level.leaf_sources,
                   c.topology.far_ends, c.topology.order, c.topology.offsets, c.names, c.geometry->positions,
                   c.geometry->triangles, layout.leaves, c.count, static_cast<std::uint32_t>(c.topology.trees()),
                   first_leaf, level.leaves, leaves.length);
        }
        first_node += level.size;
        first_leaf += level.leaves;
    }
}

} // namespace

WideLayout collapse_wide(Device& device, const Topology& topology, BufferView<const Aabb> volumes,
                         const Geometry* geometry, BufferView<const std::uint32_t> names) {
    Collapse c{device, topology, volumes, geometry, names, {}};
    c.plans = plan_collapse(c);
    const std::vector<Level> levels = choose_levels(c);
    c.plans = {};

    std::size_t nodes = 0, leaves = 0;
    for (const Level& level : levels) {
        nodes += level.size;
        leaves += level.leaves;
    }
    WideLayout layout;
    layout.nodes = make_scratch<Wide8Node>(device, nodes, "wide nodes");
    if (geometry) layout.leaves = make_scratch<Triangle4>(device, leaves, "triangle blocks");
    layout.depth = static_cast<std::uint32_t>(levels.size());
    write_levels(c, levels, layout);
    return layout;
}

} // namespace boxwood
