// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

namespace boxwood {

/// Bounding volume of the nodes of a tree, and how it is found (dissertation 3.5).
enum class Bounds {
    aabb,           ///< Axis-aligned boxes, the control.
    obb_points,     ///< PCA over every vertex below the node ("PCA unbounded").
    obb_boxes,      ///< PCA over the 16 corners of the two child boxes ("PCA bounded").
    obb_quaternion, ///< Half-way rotation between the children, extents from their 16 corners.
    obb_cascade,    ///< Points over leaves, corners and points over one leaf, quaternion above (the proposal of 3.5).
    obb_moments,    ///< PCA by merging the children's moments: the orientation of obb_points, O(1) per node.
    obb_refined,    ///< obb_points; large nodes by a search for a small box around their extremes.
};

/// Where the extents of obb_moments come from; the other kinds have their own.
enum class Extents {
    exact,   ///< All vertices below the node: tight, O(n depth) for the tree.
    corners, ///< The children's boxes: O(1) per node.
};

/// By what a node's oriented box is compared with its AABB; the smaller is kept.
enum class Measure {
    volume, ///< As in the dissertation, 3.5.
    area,   ///< What rays see.
};

/// Which boxes, how.
struct BoundsOptions {
    Bounds kind = Bounds::aabb;
    Extents extents = Extents::exact;
    Measure measure = Measure::volume;
    bool fallback = true; ///< Whether a node keeps its AABB where that is not larger.
};

/// The words used in options, reports and on the command line: "obb-points", "corners", "area". to_... throw InputError
/// listing them.
std::string_view name(Bounds kind);
std::string_view name(Extents extents);
std::string_view name(Measure measure);
Bounds to_bounds(std::string_view word);
Extents to_extents(std::string_view word);
Measure to_measure(std::string_view word);
std::vector<Bounds> all_bounds();

} // namespace boxwood
