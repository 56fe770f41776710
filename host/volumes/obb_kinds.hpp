// SPDX-License-Identifier: MIT
// What the kinds of oriented boxes need.
#pragma once

#include "boxwood/bounds.hpp"

namespace boxwood {

/// Whether nodes are fitted to the vertices of the triangles below them.
inline bool reads_points(Bounds kind) {
    return kind != Bounds::aabb && kind != Bounds::obb_boxes && kind != Bounds::obb_quaternion;
}

/// Whether nodes are merged from their children, one level after the other.
inline bool works_by_levels(Bounds kind) {
    return kind != Bounds::aabb && kind != Bounds::obb_points && kind != Bounds::obb_refined;
}

} // namespace boxwood
