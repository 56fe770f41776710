// SPDX-License-Identifier: MIT
// Every kind of bounding volume on the same topology and layout, with the same rays: what it costs and what it is
// worth.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "cli/progress.hpp"
#include "cli/rays.hpp"
#include "cli/report.hpp"

namespace boxwood::cli {

/// Builds and launches that times are the median of, kinds taking turns so that a slow stretch meets all of them.
inline constexpr std::size_t quality_builds = 5;
inline constexpr std::size_t quality_launches = 5;

/// Rays through one tree.
struct RayCost {
    RayWork work;
    std::vector<double> ms; ///< Per launch.
};

/// One kind of volumes and what was measured of it.
struct KindResult {
    std::string key; ///< Its word, or "obb-moments-corners".
    Prepared prepared;
    RayCost primary;
    RayCost bounce;
    RayWork near; ///< What the surface area heuristic does not see: rays that start where most triangles are.
    std::map<std::string, std::vector<double>> passes; ///< Milliseconds by pass, per build.

    double pass_ms(const std::string& pass) const;
};

/// The passes in their order: kernels by stage; "aabb_volumes" is the pass over axis-aligned boxes, "volumes" the
/// oriented fit that follows it, both of the bottom level; "total" is wall clock.
inline constexpr std::array quality_passes{"bounds",  "morton",   "sort",      "hierarchy", "aabb_volumes",
                                           "volumes", "collapse", "top_level", "total"};

struct QualityStudy {
    std::vector<KindResult> kinds; ///< The first is aabb, the control.
    std::size_t primary_rays = 0;
    std::size_t bounce_rays = 0;
    std::size_t near_rays = 0;
    double aabb_volumes_ms = 0.0; ///< Median over all builds of all kinds, all of which run that pass.
};

/// What to study.
struct QualityChoice {
    std::vector<std::string> words; ///< Kinds, or "all".
    BuildOptions options;
    bool extents_given = false; ///< Else obb-moments is studied with both.
    RayChoice rays;
};

/// Results to be filled: aabb, and each kind asked for.
std::vector<KindResult> kinds_of(const QualityChoice& choice);

/// Builds each kind, measures it, and traces it. `progress` is stepped study_steps(kinds) times.
QualityStudy study_quality(Device& device, const Input& input, const QualityChoice& choice, Progress& progress);
std::size_t study_steps(std::size_t kinds);

/// Builds and measures each kind with `levels`, without rays: reports by key. Empty when that does not fit the device.
std::map<std::string, BuildReport> measure_levels(Device& device, const Scene& scene, const QualityChoice& choice,
                                                  Levels levels, Progress& progress);

} // namespace boxwood::cli
