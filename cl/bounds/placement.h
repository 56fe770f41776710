// SPDX-License-Identifier: MIT
// How far off a hit in the object space of an instance may be in world space.
#ifndef BOXWOOD_BOUNDS_PLACEMENT_H
#define BOXWOOD_BOUNDS_PLACEMENT_H
#include "runtime/numerics.h"
#include "shared/instance.h"
#include "shared/scene_sphere.h"

/// Object space: how far off, along each axis, a ray may be that traversal moved there, at whatever it hits.
///
/// Let u = 2^-24, M and T be the linear part and the translation of to_object, R_k = |center_k| + 8 radius, which bounds the
/// coordinate of every origin (far ones are moved: far_origin.h) and of everything in the scene, so that t |d_k| <= 2 R_k. Three fma
/// move the origin: 3u (|M| R + |T|). The direction: 3u |M| t |d| <= 6u |M| R. The hit is off the ray, or along it, by 8u of
/// its way, 16u |M| R, and by 17u of the triangle's longest extent, itself at most 2 radii in world space: 5u |M| R. The
/// matrix is the inverse rounded once, on the way there and back: 2u (|M| R + |T|). In all 32u |M| R + 5u |T|; 40u are taken of both.
inline void object_error(global const InstanceRecord* record, const SceneSphere* sphere, float* error) {
    for (int row = 0; row < 3; ++row) {
        global const float* m = record->to_object + 4 * row;
        float sum = fabs(m[3]);
        for (int k = 0; k < 3; ++k) {
            const float reach = fma((float)BOXWOOD_NEAR_RADII, sphere->radius, fabs(sphere->center[k]));
            sum = fma(fabs(m[k]), reach, sum);
        }
        error[row] = 40.0f * 0x1p-24f * sum;
    }
}

/// The same in world space.
inline void placement_error(global const InstanceRecord* record, const SceneSphere* sphere, float* error) {
    float object[3];
    object_error(record, sphere, object);
    for (int row = 0; row < 3; ++row) {
        global const float* m = record->to_world + 4 * row;
        error[row] = fma(fabs(m[0]), object[0], fma(fabs(m[1]), object[1], fabs(m[2]) * object[2]));
    }
}

#endif
