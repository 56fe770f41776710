// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "boxwood/scene.hpp"
#include "boxwood/tree_image.hpp"
#include "shared/influence.h"

namespace boxwood {

/// Depths of nodes, both included; a root has depth 0.
struct DepthRange {
    std::uint32_t first = 0;
    std::uint32_t last = 0;
};

/// Bit k of the index: which end of axis k.
using BoxCorners = std::array<glm::vec3, 8>;

/// The corners of the volume of a slot in use.
BoxCorners slot_corners(const BinaryNode& node, std::uint32_t slot);
BoxCorners slot_corners(const OrientedNode& node, std::uint32_t slot);
BoxCorners slot_corners(const Wide8Node& node, std::uint32_t slot);

/// Of the axis-aligned hull of all slots.
BoxCorners root_corners(const BinaryNode& root);
BoxCorners root_corners(const OrientedNode& root);
BoxCorners root_corners(const Wide8Node& root);

/// The boxes that a valid tree's nodes have at some depths, leaves included, as a scene whose meshes are lists of
/// lines: eight corners a box, and twelve edges as 24 vertex numbers (each Mesh::triangles element holds the ends of
/// one and a half edges; see save_glb_lines). Depths are those of the layout: a child of a `wide8` node is one deeper,
/// however many binary nodes lie between. A root's box is the axis-aligned hull of its children's, for no layout stores
/// its own.
///
/// One level gives one mesh, "boxes". Two levels give "boxes of the top level" in world space and "boxes of NAME" for
/// each mesh, under the transform of each of its instances; depths count from each tree's own root. Without a box at
/// these depths a mesh is left out. Cameras are kept. O(nodes above and at those depths).
Scene box_lines(const TreeImage& tree, const Scene& scene, DepthRange depths);

/// Adds the regions of influence areas to lines, as boxes are: a mesh "area I" each.
void add_area_lines(std::span<const InfluenceRecord> areas, Scene& lines);

} // namespace boxwood
