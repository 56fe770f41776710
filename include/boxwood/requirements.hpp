// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "boxwood/build.hpp"
#include "boxwood/shading_requirements.hpp"

namespace boxwood {

/// What a scene and a choice of options need: build() makes what they name and nothing else, and traversal's programs
/// are specialised by the tree that results. What shading needs, ShadingRequirements, decides its programs and buffers
/// alike.
struct Requirements {
    bool two_levels = false;      ///< A top level over instances is built and traversed.
    bool instance_lookup = false; ///< One level over several instances: hits are mapped back to theirs.
    bool oriented_boxes = false;  ///< Volumes are oriented boxes.
    bool influence_areas = false; ///< Local trees in influence areas are built and searched first.
};

/// Derived from scene and options. Levels::automatic takes two levels when some mesh is placed more than once, since
/// one level would have to store it as often, or when one level would round an instance by more than rounding_limit
/// (boxwood/rounding.hpp), but one where there are influence areas. As worst_rounding where it comes to that, else
/// O(instances + meshes).
Requirements requirements(const Scene& scene, const BuildOptions& options);

/// The words for reports: "two-levels", "instance-lookup", "oriented-boxes", "influence-areas".
std::vector<std::string> words(const Requirements& needs);

/// All that requirements() and shading_requirements() name, in the order of their words. O(size of the scene).
std::vector<Reason> reasons(const Scene& scene, const BuildOptions& options);

} // namespace boxwood
