// SPDX-License-Identifier: MIT
// What a study of volumes found, as JSON and as tables.
#pragma once

#include "cli/quality_study.hpp"

namespace boxwood::cli {

/// Builds of one and of two levels by kind; both or none are filled.
struct LevelsComparison {
    std::map<std::string, BuildReport> one;
    std::map<std::string, BuildReport> two;

    bool empty() const { return one.empty() || two.empty(); }
};

/// Adds "kinds" and, when there is a comparison, "levels":
///
///     "kinds": {KEY: {"sum_volume", "sum_area", "volume_ratio", "area_ratio", "obb_smaller_fraction",
///                     "bottom": {"sum_volume", "sum_area", "obb_smaller_fraction"}, "top": {...},
///                     "sah", "end_point_overlap", "max_depth", "nodes", "peak_device_bytes",
///                     "volumes_per_ray", "primitives_per_ray", "mrays_per_s",          of bounce rays, as in "bounce"
///                     "primary": {"rays", "volumes_per_ray", "primitives_per_ray", "mrays_per_s"}, "bounce": {...},
///                     "near": {"rays", "volumes_per_ray", "primitives_per_ray"},      that leave random triangles
///                     "passes_ms": {"bounds", ..., "aabb_volumes", "volumes", ..., "total"}, "fit_ratio"}}
///     "levels": {"one": {KEY: {"all": {...}, "bottom": {...}, "top": {...}}}, "two": {...}}
///
/// Ratios are to aabb; "fit_ratio" is "volumes" over the median "aabb_volumes". KEY is a kind's word or
/// "obb-moments-corners".
void add_quality(const QualityStudy& study, const LevelsComparison& levels, Json& report);

/// Prints the same as aligned tables on standard output.
void print_quality(const QualityStudy& study, const LevelsComparison& levels, bool two_levels);

/// a / b, and 1 where both are zero, as for a scene without volume.
double ratio(double a, double b);

} // namespace boxwood::cli
