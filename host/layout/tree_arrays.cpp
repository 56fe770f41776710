// SPDX-License-Identifier: MIT
#include "layout/tree_arrays.hpp"

namespace boxwood {

AnyLayout empty_layout(Layout layout, Bounds bounds) {
    if (bounds != Bounds::aabb) return OrientedLayout{};
    if (layout == Layout::wide8) return WideLayout{};
    return BinaryLayout{};
}

AnyLayout collapse(Device& device, Layout layout, Bounds bounds, const BinaryTrees& trees, const Geometry* geometry,
                   BufferView<const std::uint32_t> names) {
    if (bounds != Bounds::aabb) return collapse_oriented(device, trees.topology, trees.volumes, trees.boxes, geometry);
    if (layout == Layout::wide8) return collapse_wide(device, trees.topology, trees.volumes, geometry, names);
    return collapse_binary(device, trees.topology, trees.volumes, geometry, names);
}

} // namespace boxwood
