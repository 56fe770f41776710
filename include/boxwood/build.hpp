// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "boxwood/bounds.hpp"
#include "boxwood/device.hpp"
#include "boxwood/influence.hpp"
#include "boxwood/morton.hpp"
#include "boxwood/quality.hpp"
#include "boxwood/scene.hpp"
#include "boxwood/tree.hpp"

namespace boxwood {

/// What makes the topology of a tree.
enum class Builder {
    lbvh,     ///< Sorted Morton codes, long runs of equal ones by codes within their bounds: fast.
    sah,      ///< Top-down by the surface area heuristic: trees that are faster to traverse.
    midpoint, ///< Top-down, by the middle of the primitives' centres along the longest axis.
    pah,      ///< Top-down by the projected area heuristic: for rays that follow influence areas.
    blend,    ///< Top-down by both, as many rays follow the areas as their shares say: one tree, no local ones.
};

/// The words used in options, reports and on the command line. to_builder throws InputError listing them.
std::string_view name(Builder builder);
Builder to_builder(std::string_view word);
/// True for the builders of known rays, pah and blend; where no area is known, sah is the same.
bool needs_areas(Builder builder);

/// How to build a tree.
struct BuildOptions {
    Levels levels = Levels::automatic; ///< automatic: by requirements() (boxwood/requirements.hpp).
    Layout layout = Layout::automatic; ///< automatic: binary for oriented boxes, else wide8.
    Builder builder = Builder::lbvh;
    MortonBits morton = MortonBits::bits30; ///< Of lbvh.
    BoundsOptions bounds = {};              ///< Oriented boxes need the binary layout.
    /// Each that holds a triangle gets a tree of its own, which rays that follow it search first; for blend they tell
    /// the only tree what rays will come. They need one level of axis-aligned boxes.
    std::vector<InfluenceArea> areas = {};
    AreaIndexKind area_index = AreaIndexKind::automatic;
    /// Fill BuildReport::overlap, which may take longer than the build; binary layout only.
    bool measure_overlap = false;
};

/// What became of an influence area.
struct AreaReport {
    std::uint64_t triangles = 0; ///< In its local tree; with none the area is left out.
};

/// What a build measured.
struct BuildReport {
    Profile profile;        ///< Stages: areas, bounds, morton, sort, hierarchy, volumes, collapse, top_level.
    double total_ms = 0.0;  ///< Wall clock of the whole build, uploads included, compilation not.
    double upload_ms = 0.0; ///< Wall clock of its flattening and uploads.
    double compile_ms = 0.0;
    /// With scratch. It does not depend on the number of threads, but with top-down builders of fewer than 32,768
    /// primitives for each: the parts that they split a node in are shorter then.
    std::uint64_t peak_device_bytes = 0;
    double sah = 0.0;     ///< Cost of one-primitive leaves by the surface area heuristic (node 1, primitive 1).
    double overlap = 0.0; ///< End-point overlap of the bottom level, if asked for (Aila et al. 2013, every node at 1).
    LevelQuality all;     ///< Both levels.
    LevelQuality bottom;  ///< In object space, each mesh once, and all local trees.
    LevelQuality top;     ///< In world space; zeros for one level.
    std::uint32_t max_depth = 0;   ///< Of the layout, bottom plus top level.
    std::uint64_t nodes = 0;       ///< Of the layout, both levels and all local trees.
    std::vector<AreaReport> areas; ///< Of BuildOptions::areas; none for blend, which builds no local trees.
};

/// Builds the tree of a valid scene with OpenCL kernels. An empty scene gives an empty tree. Throws CapacityError with
/// both numbers, before the work, when it does not fit, and InputError for oriented boxes in the wide8 layout, for
/// areas that are not valid or beside two levels or oriented boxes, and for pah and blend without areas. O(n) work in
/// the number of primitives but for the sort's passes, the rounds of codes for long runs, the levels of a top-down
/// builder and exact extents (dissertation 3.3, 3.5, 3.6).
Tree build(Device& device, const Scene& scene, const BuildOptions& options = {}, BuildReport* report = nullptr);

/// The tree of one mesh: triangle t has the vertices positions[triangles[t][k]] and is hit as primitive t of instance 0. Throws
/// InputError for an index out of range and a position that is not finite or not within largest_coordinate; else as build of a scene.
Tree build(Device& device, std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles,
           const BuildOptions& options = {}, BuildReport* report = nullptr);

} // namespace boxwood
