// SPDX-License-Identifier: MIT
// Ray against the child boxes of a node, by slabs. The test is conservative (see local_ray.h) and boxes are closed: a
// ray in the plane of a face enters.
#ifndef BOXWOOD_TRAVERSE_RAY_BOX_H
#define BOXWOOD_TRAVERSE_RAY_BOX_H
#include "runtime/lanes.h"
#include "shared/node.h"
#include "traverse/local_ray.h"

// The operand order matters: when `candidate` is NaN (0 * inf: a ray in the plane of a face) the running value stays.

/// Entry distance of one axis: `planes` are the low faces when the direction is not negative, else the high ones.
#define ENTRY(planes, axis) ((ray->origin.axis - (planes)) * ray->minus_near_inverse.axis)
#define EXIT(planes, axis) ((ray->origin.axis - (planes)) * ray->minus_far_inverse.axis)

/// Where the ray is inside one box within [t_min, t_max]: from *entry on. False when nowhere. The empty box is nowhere.
INLINE bool ray_box(const LocalRay* ray, global const Aabb* box, float t_min, float t_max, float* entry) {
    // By the sign bit, as make_local_ray has it: -0 is a direction downward.
    const bool down_x = as_int(ray->direction.x) < 0;
    const bool down_y = as_int(ray->direction.y) < 0;
    const bool down_z = as_int(ray->direction.z) < 0;
    const float entry_x = ENTRY(down_x ? box->max[0] : box->min[0], x);
    const float entry_y = ENTRY(down_y ? box->max[1] : box->min[1], y);
    const float entry_z = ENTRY(down_z ? box->max[2] : box->min[2], z);
    const float exit_x = EXIT(down_x ? box->min[0] : box->max[0], x);
    const float exit_y = EXIT(down_y ? box->min[1] : box->max[1], y);
    const float exit_z = EXIT(down_z ? box->min[2] : box->max[2], z);
    float first = GREATER(entry_x, t_min);
    first = GREATER(entry_y, first);
    first = GREATER(entry_z, first);
    float last = LESSER(exit_x, t_max);
    last = LESSER(exit_y, last);
    last = LESSER(exit_z, last);
    *entry = first;
    return first <= last;
}

/// The eight children of a wide8 node at once: bit i of the result says that child i is met, from lane i of *entry on.
INLINE uint ray_box8(const LocalRay* ray, global const Wide8Node* node, float t_min, float t_max, float8* entry) {
    // Rows of eight floats: min_x, max_x, min_y, max_y, min_z, max_z. Aligned, as buffers are to 128 bytes at least and
    // nodes have 256: vload8 would not know, and PoCL makes two loads and a shuffle of it.
    global const char* rows = (global const char*)node->min_x;
#define ROW(bytes) (*(global const float8*)(rows + (bytes)))
    const float8 entry_x = ENTRY(ROW(ray->near_x), x);
    const float8 entry_y = ENTRY(ROW(ray->near_y), y);
    const float8 entry_z = ENTRY(ROW(ray->near_z), z);
    const float8 exit_x = EXIT(ROW(ray->near_x ^ 32), x);
    const float8 exit_y = EXIT(ROW(ray->near_y ^ 32), y);
    const float8 exit_z = EXIT(ROW(ray->near_z ^ 32), z);
#undef ROW
    float8 first = (float8)(t_min);
    first = GREATER(entry_x, first);
    first = GREATER(entry_y, first);
    first = GREATER(entry_z, first);
    float8 last = (float8)(t_max);
    last = LESSER(exit_x, last);
    last = LESSER(exit_y, last);
    last = LESSER(exit_z, last);
    *entry = first;
    return lanes8(first <= last);
}

#endif
