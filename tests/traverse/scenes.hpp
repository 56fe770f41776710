// SPDX-License-Identifier: MIT
// Small random scenes and rays, and running a query, for the tests of traversal.
#pragma once

#include <string>
#include <vector>

#include "boxwood/scene.hpp"
#include "boxwood/trace.hpp"
#include "support.hpp"

namespace boxwood::test {

/// Triangles with corners in [-1, 1]^3, edges up to `size`.
Mesh random_mesh(Random& random, std::uint32_t triangles, float size);

/// A scene of one mesh, placed once without a transform.
Scene single(Mesh mesh);

/// A few meshes placed several times: rotated, mirrored, scaled unevenly, sheared.
Scene instanced_scene(Random& random, std::uint32_t meshes, std::uint32_t instances, std::uint32_t triangles);

/// Rays from in and around the cube [-reach, reach]^3 through points of it, some along an axis, some with an interval.
std::vector<Ray> random_rays(Random& random, std::uint32_t count, float reach);

std::vector<Hit> trace(const TreeImage& tree, const std::vector<Ray>& rays, const TraceOptions& options = {});
std::vector<Hit> trace(const TreeImage& tree, const std::vector<Ray>& rays, std::vector<RayStatistics>& statistics,
                       const TraceOptions& options = {});
std::vector<std::uint32_t> trace_any(const TreeImage& tree, const std::vector<Ray>& rays,
                                     const TraceOptions& options = {});

/// How many hits differ in any bit but the sign of a zero.
std::size_t count_different(const std::vector<Hit>& a, const std::vector<Hit>& b);

/// One combination of layout, levels and volumes.
struct Kind {
    Layout layout;
    Levels levels;
    Bounds bounds = Bounds::aabb;
};
inline constexpr Kind all_kinds[] = {{Layout::binary, Levels::one},
                                     {Layout::wide8, Levels::one},
                                     {Layout::binary, Levels::two},
                                     {Layout::wide8, Levels::two},
                                     {Layout::binary, Levels::one, Bounds::obb_points},
                                     {Layout::binary, Levels::two, Bounds::obb_points}};
std::string words(const Kind& kind);

} // namespace boxwood::test
