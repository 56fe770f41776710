// SPDX-License-Identifier: MIT
// Boxes of primitives: triangles, and instances of meshes.
// compile:
#include "runtime/numerics.h"
#include "bounds/placement.h"
#include "bounds/triangle_box.h"

/// boxes[i] = padded box of triangle i, for the triangles of one slice.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void triangle_bounds(global const float* positions, global const uint* triangles, global Aabb* boxes, uint count,
                     uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    if (begin >= count) return;
    const uint end = min(begin + slice, count);
    for (uint i = begin; i < end; ++i) {
        global const uint* corner = triangles + 3 * (size_t)i;
        padded_triangle_box(positions + 3 * (size_t)corner[0], positions + 3 * (size_t)corner[1],
                            positions + 3 * (size_t)corner[2], boxes + i);
    }
}

/// boxes[i] = conservative world box of instance i: its mesh's box under to_world, padded outward by the roundings of
/// that and by placement_error(), in the scene's `sphere`.
///
/// Each bound is a sum of three products and a translation. With u = 2^-24 and S the sum of the terms' magnitudes, its
/// rounding error is at most 4u S (Higham, gamma_4); 6u with that of the last sum.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void instance_bounds(global const InstanceRecord* instances, global const Aabb* mesh_boxes, global Aabb* boxes,
                     uint count, SceneSphere sphere) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const Aabb local_box = mesh_boxes[instances[i].mesh];
    float error[3];
    placement_error(&instances[i], &sphere, error);
    Aabb box;
    for (int row = 0; row < 3; ++row) {
        const float shift = instances[i].to_world[4 * row + 3];
        float low = shift, high = shift, magnitude = fabs(shift);
        for (int k = 0; k < 3; ++k) {
            const float factor = instances[i].to_world[4 * row + k];
            const float a = factor * local_box.min[k];
            const float b = factor * local_box.max[k];
            low += a < b ? a : b;
            high += a < b ? b : a;
            magnitude += fabs(a) > fabs(b) ? fabs(a) : fabs(b);
        }
        const float pad = fma(6.0f * 0x1p-24f, magnitude, error[row]);
        box.min[row] = low - pad;
        box.max[row] = high + pad;
    }
    boxes[i] = box;
}
