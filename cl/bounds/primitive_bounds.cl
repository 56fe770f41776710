// SPDX-License-Identifier: MIT
// Boxes of primitives: triangles, and instances of meshes.
// compile:
#include "runtime/numerics.h"
#include "shared/aabb.h"
#include "shared/instance.h"

/// boxes[i] = exact box of triangle i, for the triangles of one slice.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void triangle_bounds(global const float* positions, global const uint* triangles, global Aabb* boxes, uint count,
                     uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    if (begin >= count) return;
    const uint end = min(begin + slice, count);
    for (uint i = begin; i < end; ++i) {
        global const float* a = positions + 3 * (size_t)triangles[3 * (size_t)i];
        global const float* b = positions + 3 * (size_t)triangles[3 * (size_t)i + 1];
        global const float* c = positions + 3 * (size_t)triangles[3 * (size_t)i + 2];
        Aabb box;
        for (int k = 0; k < 3; ++k) {
            const float low = a[k] < b[k] ? a[k] : b[k];
            const float high = a[k] > b[k] ? a[k] : b[k];
            box.min[k] = low < c[k] ? low : c[k];
            box.max[k] = high > c[k] ? high : c[k];
        }
        boxes[i] = box;
    }
}

/// boxes[i] = conservative world box of instance i: its mesh's box under to_world, padded outward.
///
/// Each bound is a sum of three products and a translation. With u = 2^-24 and S the sum of the terms' magnitudes, its
/// rounding error is at most 4 u S (Higham, gamma_4). Traversal moves the ray by to_object, whose entries are rounded
/// once and applied with the same number of operations, which moves the hit by as much again for a well-conditioned
/// matrix. So the pad is 8 u S, rounded up to 9 for the pad's own rounding.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void instance_bounds(global const InstanceRecord* instances, global const Aabb* mesh_boxes, global Aabb* boxes,
                     uint count) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const Aabb local_box = mesh_boxes[instances[i].mesh];
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
        const float pad = 9.0f * 0x1p-24f * magnitude;
        box.min[row] = low - pad;
        box.max[row] = high + pad;
    }
    boxes[i] = box;
}
