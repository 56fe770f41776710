// SPDX-License-Identifier: MIT
// The trees in influence areas, built in the same launches as the global one.
#pragma once

#include <cstdint>
#include <vector>

#include "boxwood/build.hpp"
#include "boxwood/geometry.hpp"

namespace boxwood {

/// The triangles of local trees, which stand behind those of the scene.
struct LocalTrees {
    std::vector<LocalArea> areas;     ///< Those that hold triangles, `root` not filled.
    std::vector<AreaReport> reports;  ///< Of all areas.
    std::vector<std::uint32_t> sizes; ///< Triangles by area of `areas`.
    Buffer<InfluenceRecord> rays;     ///< What follows the areas of `areas`, for builders.
    Buffer<std::uint32_t> ray_starts; ///< By tree, the global one first: its part of `rays`.
    Buffer<std::uint32_t> names;      ///< Of each triangle of the scene and of the local trees: its index in the scene.
};

/// Finds the triangles of each area in a flattened scene and adds them to geometry.triangles. Throws InputError for
/// invalid areas and CapacityError when the trees do not fit.
LocalTrees add_local_triangles(Device& device, const Scene& flat, const BuildOptions& options, Geometry& geometry);

/// An area as traversal needs it, but for the root of its tree.
LocalArea local_area(const InfluenceRecord& record);

} // namespace boxwood
