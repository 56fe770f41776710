// SPDX-License-Identifier: MIT
// The passes of a build, shared with the updates of an animated scene. Options are resolved ones.
#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

#include "boxwood/geometry.hpp"
#include "build/local_trees.hpp"
#include "layout/tree_arrays.hpp"

namespace boxwood {

/// What a build makes on its way to the tree.
struct BuildParts {
    Geometry geometry;
    std::vector<std::uint32_t> offsets; ///< Where the triangles of each mesh start among all, and how many all are.
    LocalTrees local;                   ///< Of influence areas; their triangles stand behind all, in offsets too.
    BinaryTrees bottom;
    Buffer<Obb> mesh_boxes;                         ///< Two levels of oriented boxes: by mesh, the box of its root.
    BinaryTrees top;                                ///< Two levels.
    std::chrono::steady_clock::time_point uploaded; ///< When the geometry was on the device.
};

/// A tree of the kind that `options` ask for, without nodes.
TreeArrays start_tree(const BuildOptions& options, const SceneSphere& sphere);

/// True when the scene is its own flattened form: one mesh, placed once without a transform.
bool is_flat(const Scene& scene);

/// The tree of a scene with instances. Flattens where one level needs it. Waits.
TreeArrays build_tree(Device& device, const Scene& scene, const BuildOptions& options, BuildParts& parts);

/// The axis-aligned boxes of `parts.bottom` from the positions in `parts.geometry`, over the topology it has.
void refit_bottom_level(Device& device, BuildParts& parts);

/// The rest of a build, from the axis-aligned boxes of the bottom level on: its oriented boxes and layout, then the top
/// level. Of `scene` only the instances are read. Waits.
void finish_tree(Device& device, const Scene& scene, const BuildOptions& options, BuildParts& parts, TreeArrays& tree);

/// The tree over instances (dissertation 3.6.2): the same passes over the boxes of the placed meshes. Fills the top
/// arrays of `tree` and parts.top from offsets, mesh_boxes and the bounds of the trees in `parts`.
void build_top_level(Device& device, const Scene& scene, const BuildOptions& options, BuildParts& parts,
                     TreeArrays& tree);

} // namespace boxwood
