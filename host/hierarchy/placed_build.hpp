// SPDX-License-Identifier: MIT
// The steps of a build, shared with the updates of an animated scene.
#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

#include "boxwood/build.hpp"
#include "boxwood/geometry.hpp"
#include "hierarchy/forest.hpp"
#include "hierarchy/local_trees.hpp"

namespace boxwood {

/// What a build makes on its way to the tree.
struct BuildParts {
    Geometry geometry;
    std::vector<std::uint32_t> offsets; ///< Where the triangles of each mesh start among all, and how many all are.
    LocalTrees local;                   ///< Of influence areas; their triangles stand behind all, in offsets too.
    Forest bottom;
    Buffer<Obb> mesh_boxes;                         ///< Two levels of oriented boxes: by mesh, the box of its root.
    Forest top;                                     ///< Two levels.
    std::chrono::steady_clock::time_point uploaded; ///< When the geometry was on the device.
};

/// The tree that a build starts from: `options` resolved, no nodes. Throws InputError for options that do not go together.
Tree empty_tree(const BuildOptions& options);

/// True when the scene is its own flattened form: one mesh, placed once without a transform.
bool is_flat(const Scene& scene);

/// The tree of a scene with instances, but for first_triangles. Flattens where one level needs it. Waits.
Tree build_tree(Device& device, const Scene& scene, const BuildOptions& options, BuildParts& parts);

/// One level over several instances: uploads `tree.first_triangles`.
void add_instance_lookup(Device& device, const Scene& scene, Tree& tree);

/// The axis-aligned boxes of `parts.bottom` from the positions in `parts.geometry`, over the topology it has.
void fit_bottom(Device& device, BuildParts& parts);

/// From the axis-aligned boxes of the bottom level on: its oriented boxes and layout, then the top level of a `tree` of
/// two levels. Of `scene` only the instances are read.
void lay_out(Device& device, const Scene& scene, const BuildOptions& options, BuildParts& parts, Tree& tree);

/// The tree over instances (dissertation 3.6.2): the same passes over the boxes of the placed meshes. Fills the top arrays
/// of `tree` and parts.top from offsets, mesh_boxes and the bounds of the trees in `parts`.
void build_top_level(Device& device, const Scene& scene, const BuildOptions& options, BuildParts& parts, Tree& tree);

} // namespace boxwood
