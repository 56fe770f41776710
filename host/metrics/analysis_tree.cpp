// SPDX-License-Identifier: MIT
#include <algorithm>

#include "boxwood/analysis.hpp"
#include "metrics/tree_boxes.hpp"
#include "tree_image/tree_walker.hpp"

namespace boxwood {

namespace {

/// Sums up primitives from the leaves to the root: parents come before their children.
void sum_primitives(AnalysisTree& tree) {
    for (std::size_t i = tree.nodes.size(); i-- > 1;)
        tree.nodes[tree.nodes[i].parent].primitives += tree.nodes[i].primitives;
}

/// Appends a child of `parent`; children of one parent are appended together.
AnalysisNode& add_child(AnalysisTree& tree, std::uint32_t parent, const Aabb& box) {
    AnalysisNode& above = tree.nodes[parent];
    const auto index = static_cast<std::uint32_t>(tree.nodes.size());
    if (above.children++ == 0) above.first_child = index;
    tree.nodes.push_back({box, above.level + 1, parent, 0, 0, 0});
    return tree.nodes.back();
}

Aabb hull_of(const BoxCorners& corners) {
    Aabb box;
    for (int k = 0; k < 3; ++k) {
        const auto [low, high] =
            std::ranges::minmax_element(corners, {}, [k](const glm::vec3& corner) { return corner[k]; });
        box.min[k] = (*low)[k];
        box.max[k] = (*high)[k];
    }
    return box;
}

std::uint32_t primitives_of(const Triangle4& block) {
    return static_cast<std::uint32_t>(
        std::ranges::count_if(block.primitive, [](std::uint32_t primitive) { return primitive != BOXWOOD_NONE; }));
}

/// The tree under node `root`; primitives(leaf) says how many a leaf holds.
template <class Node, class Primitives>
AnalysisTree stored_tree(const std::vector<Node>& nodes, std::uint32_t root, std::string name,
                         const Primitives& primitives) {
    constexpr bool oriented = std::is_same_v<Node, OrientedNode>;
    AnalysisTree tree{std::move(name), {}, {}};
    const BoxCorners hull = root_corners(nodes[root]);
    tree.nodes.push_back({hull_of(hull), 0, BOXWOOD_NONE, 0, 0, 0});
    if (oriented) tree.corners.push_back(hull);
    std::vector<std::uint32_t> references{root}; // by node
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
        if (references[i] & BOXWOOD_LEAF) {
            tree.nodes[i].primitives = primitives(references[i] & ~BOXWOOD_LEAF);
            continue;
        }
        const Node& node = nodes[references[i]];
        for (std::uint32_t slot = 0; slot < detail::tree_check::used_slots(node); ++slot) {
            const BoxCorners corners = slot_corners(node, slot);
            add_child(tree, i, hull_of(corners));
            if (oriented) tree.corners.push_back(corners);
            references.push_back(detail::tree_check::reference_of(node, slot));
        }
    }
    sum_primitives(tree);
    return tree;
}

AnalysisTree stored_tree(const TreeImage& image, bool top, std::uint32_t root, std::string name) {
    const auto one = [](std::uint32_t) { return 1u; };
    if (image.layout == Layout::wide8) {
        if (top) return stored_tree(image.wide_top, root, std::move(name), one);
        return stored_tree(image.wide_nodes, root, std::move(name),
                           [&](std::uint32_t leaf) { return primitives_of(image.blocks[leaf]); });
    }
    if (image.bounds != Bounds::aabb)
        return stored_tree(top ? image.oriented_top : image.oriented_nodes, root, std::move(name), one);
    return stored_tree(top ? image.binary_top : image.binary_nodes, root, std::move(name), one);
}

} // namespace

AnalysisTree analysis_tree(Device& device, const Topology& topology, BufferView<const Aabb> volumes,
                           BufferView<const std::uint32_t> leaves, std::size_t tree) {
    AnalysisTree result;
    const std::vector<std::uint32_t> offsets = download(device, topology.offsets);
    const std::vector<cl_uint2> children = download(device, topology.children);
    const std::vector<std::uint32_t> far_ends = download(device, topology.far_ends);
    const std::vector<Aabb> boxes = download(device, volumes);
    const std::vector<std::uint32_t> marks = download(device, leaves);
    const auto count = static_cast<std::uint32_t>(topology.size());
    if (tree + 1 >= offsets.size() || offsets[tree + 1] == offsets[tree]) return result;
    const std::uint32_t first = offsets[tree];
    std::vector<std::uint32_t> indices{offsets[tree + 1] - first == 1 ? count + first : first};
    result.nodes.push_back({boxes[indices[0]], 0, BOXWOOD_NONE, 0, 0, 0});
    for (std::uint32_t i = 0; i < result.nodes.size(); ++i) {
        const std::uint32_t node = indices[i];
        if (node >= count) {
            result.nodes[i].primitives = 1;
        } else if (!marks.empty() && marks[node]) {
            result.nodes[i].primitives = std::max(node, far_ends[node]) - std::min(node, far_ends[node]) + 1;
        } else {
            for (const std::uint32_t child : children[node].s) {
                add_child(result, i, boxes[child]);
                indices.push_back(child);
            }
        }
    }
    sum_primitives(result);
    return result;
}

std::vector<AnalysisTree> analysis_trees(const TreeImage& image, const Scene& scene) {
    std::vector<AnalysisTree> trees;
    if (scene.instances.empty()) return trees;
    if (image.levels == Levels::one) {
        trees.push_back(stored_tree(image, false, 0, "tree"));
        for (std::size_t i = 0; i < image.areas.size(); ++i)
            trees.push_back(stored_tree(image, false, image.areas[i].root, "local tree " + std::to_string(i)));
        return trees;
    }
    trees.push_back(stored_tree(image, true, 0, "top level"));
    std::vector<bool> seen(scene.meshes.size());
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const std::uint32_t mesh = scene.instances[i].mesh;
        if (seen[mesh]) continue;
        seen[mesh] = true;
        trees.push_back(stored_tree(image, false, image.instances[i].root, scene.meshes[mesh].name));
    }
    return trees;
}

std::vector<InfluenceRecord> stored_areas(const TreeImage& image) {
    std::vector<InfluenceRecord> records;
    for (const LocalArea& area : image.areas) {
        records.push_back(area.region);
        records.back().near = area.near;
    }
    return records;
}

} // namespace boxwood
