// SPDX-License-Identifier: MIT
#include "metrics/tree_boxes.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <utility>

#include "boxwood/influence.hpp"
#include "tree_image/tree_walker.hpp"

namespace boxwood {

namespace {

BoxCorners corners_of(const Aabb& box) {
    BoxCorners corners;
    for (int i = 0; i < 8; ++i)
        for (int k = 0; k < 3; ++k) corners[i][k] = i >> k & 1 ? box.max[k] : box.min[k];
    return corners;
}

/// `box`: center, extent, axes by columns (see shared/node.h).
BoxCorners corners_of_oriented(const float* box) {
    glm::dmat3 axes;
    for (int i = 0; i < 9; ++i) axes[i / 3][i % 3] = box[6 + i];
    const glm::dmat3 edges = glm::inverse(axes);
    BoxCorners corners;
    for (int i = 0; i < 8; ++i) {
        glm::dvec3 point(box[0], box[1], box[2]);
        for (int k = 0; k < 3; ++k) point += (i >> k & 1 ? 1.0 : -1.0) * box[3 + k] * edges[k];
        corners[i] = point;
    }
    return corners;
}

void add_box(const BoxCorners& corners, Mesh& lines) {
    const auto first = static_cast<std::uint32_t>(lines.positions.size());
    lines.positions.insert(lines.positions.end(), corners.begin(), corners.end());
    std::array<std::uint32_t, 24> ends{};
    std::size_t end = 0;
    for (std::uint32_t from = 0; from < 8; ++from) {
        for (std::uint32_t axis = 1; axis < 8; axis *= 2) {
            if (from & axis) continue;
            ends[end++] = first + from;
            ends[end++] = first + from + axis;
        }
    }
    for (std::size_t i = 0; i < ends.size(); i += 3) lines.triangles.emplace_back(ends[i], ends[i + 1], ends[i + 2]);
}

template <class Node>
BoxCorners hull_corners(const Node& root) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    glm::vec3 low(infinity), high(-infinity);
    for (std::uint32_t slot = 0; slot < detail::tree_check::used_slots(root); ++slot) {
        for (const glm::vec3& corner : slot_corners(root, slot)) {
            low = glm::min(low, corner);
            high = glm::max(high, corner);
        }
    }
    return corners_of(Aabb{{low.x, low.y, low.z}, {high.x, high.y, high.z}});
}

template <class Node>
Mesh tree_lines(const std::vector<Node>& nodes, std::uint32_t root, DepthRange depths, std::string name) {
    Mesh lines{std::move(name), {}, {}};
    if (depths.first == 0) add_box(root_corners(nodes[root]), lines);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> waiting{{root, 1}}; // a node and the depth of its children
    while (!waiting.empty()) {
        const auto [index, depth] = waiting.back();
        waiting.pop_back();
        if (depth > depths.last) continue;
        const Node& node = nodes[index];
        for (std::uint32_t slot = 0; slot < detail::tree_check::used_slots(node); ++slot) {
            if (depth >= depths.first) add_box(slot_corners(node, slot), lines);
            const std::uint32_t child = detail::tree_check::reference_of(node, slot);
            if (!(child & BOXWOOD_LEAF)) waiting.emplace_back(child, depth + 1);
        }
    }
    return lines;
}

Mesh lines_of(const TreeImage& tree, bool top, std::uint32_t root, DepthRange depths, std::string name) {
    if (tree.layout == Layout::wide8)
        return tree_lines(top ? tree.wide_top : tree.wide_nodes, root, depths, std::move(name));
    if (tree.bounds != Bounds::aabb)
        return tree_lines(top ? tree.oriented_top : tree.oriented_nodes, root, depths, std::move(name));
    return tree_lines(top ? tree.binary_top : tree.binary_nodes, root, depths, std::move(name));
}

void add_mesh(Mesh lines, Scene& result) {
    result.instances.push_back({lines.name, static_cast<std::uint32_t>(result.meshes.size()), glm::mat4(1.0f)});
    result.meshes.push_back(std::move(lines));
}

/// The boxes of each mesh that has an instance, and its instances.
void add_bottom_lines(const TreeImage& tree, const Scene& scene, DepthRange depths, Scene& result) {
    constexpr std::uint32_t unseen = BOXWOOD_NONE, empty = BOXWOOD_NONE - 1;
    std::vector<std::uint32_t> placed(scene.meshes.size(), unseen);
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        Instance instance = scene.instances[i];
        std::uint32_t& mesh = placed[instance.mesh];
        if (mesh == unseen) {
            Mesh lines =
                lines_of(tree, false, tree.instances[i].root, depths, "boxes of " + scene.meshes[instance.mesh].name);
            mesh = lines.positions.empty() ? empty : static_cast<std::uint32_t>(result.meshes.size());
            if (mesh != empty) result.meshes.push_back(std::move(lines));
        }
        if (mesh == empty) continue;
        instance.mesh = mesh;
        result.instances.push_back(std::move(instance));
    }
}

} // namespace

BoxCorners slot_corners(const BinaryNode& node, std::uint32_t slot) {
    return corners_of(detail::tree_check::slot_box(node, slot));
}
BoxCorners slot_corners(const Wide8Node& node, std::uint32_t slot) {
    return corners_of(detail::tree_check::slot_box(node, slot));
}
BoxCorners slot_corners(const OrientedNode& node, std::uint32_t slot) {
    if (node.child[slot] & BOXWOOD_ALIGNED) return corners_of(detail::tree_check::slot_box(node, slot));
    return corners_of_oriented(node.volume[slot]);
}

BoxCorners root_corners(const BinaryNode& root) { return hull_corners(root); }
BoxCorners root_corners(const OrientedNode& root) { return hull_corners(root); }
BoxCorners root_corners(const Wide8Node& root) { return hull_corners(root); }

Scene box_lines(const TreeImage& tree, const Scene& scene, DepthRange depths) {
    Scene result;
    result.cameras = scene.cameras;
    if (scene.instances.empty()) return result;
    const bool two = tree.levels == Levels::two;
    Mesh first = lines_of(tree, two, 0, depths, two ? "boxes of the top level" : "boxes");
    if (!first.positions.empty()) add_mesh(std::move(first), result);
    if (two) add_bottom_lines(tree, scene, depths, result);
    return result;
}

void add_area_lines(std::span<const InfluenceRecord> areas, Scene& lines) {
    for (std::size_t i = 0; i < areas.size(); ++i) {
        const std::array<glm::dvec3, 8> exact = corners(areas[i]);
        BoxCorners ends;
        std::copy(exact.begin(), exact.end(), ends.begin());
        Mesh mesh{"area " + std::to_string(i), {}, {}};
        add_box(ends, mesh);
        add_mesh(std::move(mesh), lines);
    }
}

} // namespace boxwood
