// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "boxwood/build.hpp"
#include "boxwood/scene.hpp"

namespace boxwood {

/// What a scene and a choice of options need. Programs are specialised by it, and what it does not name is neither
/// compiled nor allocated.
struct Requirements {
    bool two_levels = false;      ///< A top level over instances is built and traversed.
    bool instance_lookup = false; ///< One level over several instances: hits are mapped back to theirs.
    bool oriented_boxes = false;  ///< Volumes are oriented boxes.
};

/// Derived from scene and options. Levels::automatic takes two levels when some mesh is placed more than once, since
/// one level would have to store it as often. O(instances + meshes).
Requirements requirements(const Scene& scene, const BuildOptions& options);

/// The words for reports: "two-levels", "instance-lookup", "oriented-boxes".
std::vector<std::string> words(const Requirements& requirements);

} // namespace boxwood
