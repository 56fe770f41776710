// SPDX-License-Identifier: MIT
// Bounds the error, in world space, of a hit computed in the object space of an instance.
#ifndef BOXWOOD_BOUNDS_PLACEMENT_H
#define BOXWOOD_BOUNDS_PLACEMENT_H
#include "runtime/numerics.h"
#include "shared/instance.h"
#include "shared/scene_sphere.h"

/// Object space: how far off, along each axis, a ray may be that traversal moved there, at whatever it hits.
///
/// Let u = 2^-24, M the linear part of to_object, p the instance's place and r the sphere's radius. Origins are within
/// 8r of its center c on every axis (far ones are moved: far_origin.h) and everything else within r, so that E_k = 8r +
/// |c_k - p_k| bounds what is subtracted and t |d_k| <= 9r. The difference and three products move the origin: 4u |M|
/// E. The direction: 3u |M| t |d| <= 27u |M| r. The hit is off the ray, or along it, by 10u of its way, 90u |M| r, and
/// by 17u of the triangle's longest extent, itself at most 2r in world space: 34u |M| r. The matrix is the inverse
/// rounded once, on the way back too: 2u |M| E. In all at most |M| (151r + 6E) u; 24u |M| E are taken.
inline void object_error(global const InstanceRecord* record, const SceneSphere* sphere, float* error) {
    for (int row = 0; row < 3; ++row) {
        float sum = 0.0f;
        for (int k = 0; k < 3; ++k) {
            const float away = fabs(sphere->center[k] - record->to_world[4 * k + 3]);
            sum = fma(fabs(record->to_object[4 * row + k]), fma((float)BOXWOOD_NEAR_RADII, sphere->radius, away), sum);
        }
        error[row] = 24.0f * 0x1p-24f * sum;
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
