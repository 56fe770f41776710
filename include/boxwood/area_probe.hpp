// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "boxwood/build.hpp"
#include "boxwood/influence.hpp"
#include "boxwood/scene.hpp"

namespace boxwood {

/// An influence area that a probe of rays suggests, and what it would be worth.
struct ProbedArea {
    InfluenceArea area; ///< Its share is that of the probe's rays.
    std::string rays;   ///< primary, shadow or diffuse.
    std::uint64_t count = 0;
    double global_cost = 0.0; ///< Volumes and primitives tested by one of its rays in a tree without areas.
    double local_cost = 0.0;  ///< The same with the area, its lookup counted as a volume.
    bool kept = false;        ///< The local cost is lower, and local trees, where the builder makes any, answer.
};

/// Traces 16 x 16 rays of the camera and those that leave their hits, towards the default light and diffusely, looks
/// for lines through one point and for parallel ones, 16 at the least, and builds a tree with each area found to see
/// what it saves. `options` are those of the tree, of one level; its areas and levels are not read. Empty for a scene
/// without triangles. Throws as build and primary_rays do. Waits.
std::vector<ProbedArea> probe_areas(Device& device, const Scene& scene, const Camera& camera,
                                    const BuildOptions& options);

/// The same judgement of areas that are known, by rays from what their own rays hit back to where they start, as shadow
/// rays run towards a light: one result for each area, its share as it was; none for a scene without triangles. These
/// rays meet nothing before they leave the region, so that local trees answer none and the areas are kept for a builder
/// without local trees only. Throws as validate and build do.
std::vector<ProbedArea> judge_areas(Device& device, const Scene& scene, const std::vector<InfluenceArea>& areas,
                                    const BuildOptions& options);

} // namespace boxwood
