// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "boxwood/buffer.hpp"
#include "boxwood/tree_image.hpp"

namespace boxwood {

/// A built tree on a device. Members mean what they mean in TreeImage.
struct Tree {
    Layout layout = Layout::wide8;
    Levels levels = Levels::one;

    Bounds bounds = Bounds::aabb;

    Buffer<BinaryNode> binary_nodes;
    Buffer<OrientedNode> oriented_nodes;
    Buffer<Triangle> triangles;
    Buffer<Wide8Node> wide_nodes;
    Buffer<Triangle4> blocks;

    Buffer<BinaryNode> binary_top;
    Buffer<OrientedNode> oriented_top;
    Buffer<Wide8Node> wide_top;
    Buffer<InstanceRecord> instances;
    Buffer<std::uint32_t> first_triangles;

    Buffer<LocalArea> areas;
    Buffer<AreaNode> area_nodes; ///< Of TreeImage::area_index, likewise the items.
    Buffer<std::uint32_t> area_items;
    AreaIndexKind area_index = AreaIndexKind::list;

    SceneSphere sphere{};
    std::uint32_t bottom_depth = 0;
    std::uint32_t top_depth = 0;

    bool empty() const { return binary_nodes.size() + oriented_nodes.size() + wide_nodes.size() == 0; }
};

/// Copies a tree to the host; waits.
TreeImage download(Device& device, const Tree& tree);

/// Copies a valid image (see validate) to a device. Throws CapacityError when it does not fit.
Tree upload(Device& device, const TreeImage& image);

} // namespace boxwood
