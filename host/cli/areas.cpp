// SPDX-License-Identifier: MIT
#include "cli/areas.hpp"

#include <iomanip>
#include <sstream>
#include <vector>

#include "tree_image/tree_walker.hpp"

namespace boxwood::cli {

namespace {

/// Bytes of the nodes and leaves below root 0; of a valid tree.
template <class Node>
std::uint64_t tree_bytes(const std::vector<Node>& nodes, std::size_t leaf_bytes) {
    std::uint64_t bytes = 0;
    std::vector<std::uint32_t> waiting(nodes.empty() ? 0 : 1, 0u);
    while (!waiting.empty()) {
        const Node& node = nodes[waiting.back()];
        waiting.pop_back();
        bytes += sizeof(Node);
        for (std::uint32_t slot = 0; slot < detail::tree_check::used_slots(node); ++slot) {
            const std::uint32_t child = detail::tree_check::reference_of(node, slot);
            if (child & BOXWOOD_LEAF)
                bytes += leaf_bytes;
            else
                waiting.push_back(child);
        }
    }
    return bytes;
}

template <class Node, class Leaf>
void add_trees(const std::vector<Node>& nodes, const std::vector<Leaf>& leaves, AreaMemory& memory) {
    memory.global_tree = tree_bytes(nodes, sizeof(Leaf));
    memory.local_trees = nodes.size() * sizeof(Node) + leaves.size() * sizeof(Leaf) - memory.global_tree;
}

std::string word_of(AreaKind kind) { return kind == AreaKind::plane ? "plane" : "point"; }

std::string mebibytes(std::uint64_t bytes) {
    std::ostringstream out;
    out << std::fixed << std::setprecision(2) << static_cast<double>(bytes) / 1048576.0 << " MiB";
    return out.str();
}

} // namespace

AreaMemory area_memory(const TreeImage& tree) {
    AreaMemory memory;
    if (tree.layout == Layout::wide8)
        add_trees(tree.wide_nodes, tree.blocks, memory);
    else
        add_trees(tree.binary_nodes, tree.triangles, memory);
    memory.areas = tree.areas.size() * sizeof(LocalArea);
    memory.index = tree.area_index.bytes();
    return memory;
}

void add_areas(const TreeImage& tree, const Prepared& prepared, Json& report) {
    for (const ProbedArea& each : prepared.probed)
        report["probe"].push_back({{"rays", each.rays},
                                   {"count", each.count},
                                   {"kind", word_of(each.area.kind)},
                                   {"global_cost", each.global_cost},
                                   {"local_cost", each.local_cost},
                                   {"kept", each.kept}});
    if (prepared.options.areas.empty() || prepared.options.builder == Builder::blend) return;
    const AreaMemory memory = area_memory(tree);
    Json& areas = report["areas"];
    areas["kept"] = tree.areas.size();
    areas["index"] = name(tree.area_index.kind);
    if (prepared.report) {
        areas["triangles"] = Json::array();
        for (const AreaReport& area : prepared.report->areas) areas["triangles"].push_back(area.triangles);
    }
    areas["global_tree_bytes"] = memory.global_tree;
    areas["local_tree_bytes"] = memory.local_trees;
    areas["area_bytes"] = memory.areas;
    areas["index_bytes"] = memory.index;
}

std::string area_summary(const TreeImage& tree, const Prepared& prepared) {
    std::ostringstream out;
    out << std::fixed << std::setprecision(1);
    for (const ProbedArea& each : prepared.probed) {
        out << word_of(each.area.kind) << " area of " << grouped(each.count) << ' ' << each.rays << " rays";
        if (each.count > 0) out << ": " << each.local_cost << " tests per ray instead of " << each.global_cost;
        out << (each.kept ? ", kept\n" : ", not kept\n");
    }
    if (prepared.options.areas.empty() || prepared.options.builder == Builder::blend) return out.str();
    const AreaMemory memory = area_memory(tree);
    out << grouped(tree.areas.size()) << " of " << grouped(prepared.options.areas.size())
        << " influence areas hold triangles; global tree " << mebibytes(memory.global_tree) << ", local trees "
        << mebibytes(memory.local_trees) << ", areas " << grouped(memory.areas) << " bytes, "
        << name(tree.area_index.kind) << " of them " << grouped(memory.index) << " bytes\n";
    return out.str();
}

} // namespace boxwood::cli
