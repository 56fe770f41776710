// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "boxwood/area_index.hpp"
#include "boxwood/bounds.hpp"
#include "boxwood/scene.hpp"
#include "shared/instance.h"
#include "shared/node.h"
#include "shared/triangle.h"

namespace boxwood {

/// Node layout that traversal reads; a tree never has `automatic`.
enum class Layout { automatic, binary, wide8 };

/// One tree over everything flattened to world space, or a tree per mesh under a tree over instances.
enum class Levels { automatic, one, two };

/// The words used in options, reports and on the command line. to_layout and to_levels throw InputError listing them.
std::string_view name(Layout layout);
std::string_view name(Levels levels);
Layout to_layout(std::string_view word);
Levels to_levels(std::string_view word);

/// A built tree in plain host arrays: what a .bxw file stores and what the device traverses. Exactly the arrays of
/// its layout are filled. The top arrays and `instances` are filled for two levels only; one level has its root at
/// node 0. An empty tree has no nodes.
struct TreeImage {
    Layout layout = Layout::wide8;
    Levels levels = Levels::one; ///< never automatic

    Bounds bounds = Bounds::aabb; ///< With oriented boxes the oriented arrays stand for the binary ones.

    std::vector<BinaryNode> binary_nodes;     ///< Bottom level; leaf references index `triangles`.
    std::vector<OrientedNode> oriented_nodes; ///< The same with oriented boxes.
    std::vector<Triangle> triangles;
    std::vector<Wide8Node> wide_nodes; ///< Bottom level; leaf references index `blocks`. Children come after parents.
    std::vector<Triangle4> blocks;

    std::vector<BinaryNode> binary_top; ///< Top level, root 0; leaf references index `instances`.
    std::vector<OrientedNode> oriented_top;
    std::vector<Wide8Node> wide_top;
    std::vector<InstanceRecord> instances; ///< Same order as Scene::instances.

    /// One level over a scene with more than one instance: where each instance's triangles start in the flattened
    /// scene, and the total at the end; instances + 1 entries, ascending. Empty otherwise.
    std::vector<std::uint32_t> first_triangles;

    /// Influence areas with local trees, for one level of axis-aligned boxes: their trees stand behind the global one
    /// in the same arrays, over triangles that it holds too, named as there.
    std::vector<LocalArea> areas;
    AreaIndex area_index; ///< Finds `areas`; empty without any.

    SceneSphere sphere{}; ///< scene_sphere() of the scene.

    std::uint32_t bottom_depth = 0; ///< Most nodes on a path from a bottom root to a leaf's parent, over all trees.
    std::uint32_t top_depth = 0;
};

/// Throws InputError(file, element, what) unless traversal of `tree` is safe and finds every triangle of `scene`, which
/// must itself be valid: exactly the arrays of the layout and levels are filled; every reference is in range and no
/// node or leaf is reached twice; depths are as stated; boxes are ordered and not NaN, unused slots as shared/node.h
/// and shared/triangle.h say; every primitive that an instance reaches is in exactly one leaf, within its mesh for two
/// levels and within flatten(scene) for one, and each local tree holds as many of those once; areas and their index are
/// as shared/area.h says; instance records agree with scene.instances. Nodes that no root reaches are not read, and a
/// mesh without an instance may be what bottom_depth counts. Does not compare boxes or triangles with the scene's
/// positions. O(nodes + triangles + instances) time, a bit each of memory, and a word for each triangle of a local
/// tree.
void validate(const TreeImage& tree, const Scene& scene, const std::string& file);

} // namespace boxwood
