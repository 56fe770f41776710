// SPDX-License-Identifier: MIT
// What a Tree holds on the device.
#pragma once

#include <variant>

#include "boxwood/collapse.hpp"
#include "boxwood/tree.hpp"
#include "shared/area.h"
#include "volumes/binary_trees.hpp"

namespace boxwood {

using AnyLayout = std::variant<WideLayout, BinaryLayout, OrientedLayout>;

namespace detail {

/// Members mean what they mean in TreeImage.
struct TreeArrays {
    Layout layout = Layout::wide8;
    Levels levels = Levels::one;
    Bounds bounds = Bounds::aabb;

    AnyLayout bottom;
    AnyLayout top; ///< The same alternative as `bottom`; no nodes in a tree of one level.
    Buffer<InstanceRecord> instances;
    Buffer<std::uint32_t> first_triangles;

    Buffer<LocalArea> areas;
    Buffer<AreaNode> area_nodes; ///< Of TreeImage::area_index, likewise the items.
    Buffer<std::uint32_t> area_items;
    AreaIndexKind area_index = AreaIndexKind::list;

    SceneSphere sphere{};
};

} // namespace detail

using detail::TreeArrays;

/// An empty layout of the kind.
AnyLayout empty_layout(Layout layout, Bounds bounds);

/// `trees` in that layout, over the triangles of `geometry` or, without, over instances; `names` as for collapse_wide.
/// Waits.
AnyLayout collapse(Device& device, Layout layout, Bounds bounds, const BinaryTrees& trees, const Geometry* geometry,
                   BufferView<const std::uint32_t> names = {});

/// run(bottom, top), both WideLayout, BinaryLayout or OrientedLayout: the only place where kernels and files meet the
/// kind.
template <class Run>
decltype(auto) visit_layout(const TreeArrays& tree, const Run& run) {
    return std::visit([&]<class One>(const One& bottom) { return run(bottom, std::get<One>(tree.top)); }, tree.bottom);
}

} // namespace boxwood
