// SPDX-License-Identifier: MIT
#ifndef BOXWOOD_SHARED_SCENE_SPHERE_H
#define BOXWOOD_SHARED_SCENE_SPHERE_H
#include "shared/types.h"

// Rays that start farther than this many radii from the center, on any axis, have their origin moved before they are
// traced.
#define BOXWOOD_NEAR_RADII 8

BOXWOOD_SHARED_BEGIN

/// A sphere around all of a scene in world space. It gives traversal its unit of length, and says which rays come from
/// far away.
typedef struct SceneSphere {
    float center[3];
    float radius; ///< Not negative; 0 for an empty scene.
} SceneSphere;
BOXWOOD_SHARED_SIZE(SceneSphere, 16)

BOXWOOD_SHARED_END
#endif
