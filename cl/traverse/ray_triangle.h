// SPDX-License-Identifier: MIT
// Ray against triangle after Moller and Trumbore (1997), without any epsilon, one triangle or four at a time. Both
// layouts run the same text, on float or float4, so a triangle gives the same bits in both.
#ifndef BOXWOOD_TRAVERSE_RAY_TRIANGLE_H
#define BOXWOOD_TRAVERSE_RAY_TRIANGLE_H
#include "runtime/lanes.h"
#include "shared/triangle.h"
#include "traverse/local_ray.h"

#if LAYOUT == 8
typedef float4 real_t;
#define LOAD_REAL(array, axis) vload4(0, leaf->array##_##axis)
#define HOLDING(mask) lanes4(mask)
#else
typedef float real_t;
#define AXIS_x 0
#define AXIS_y 1
#define AXIS_z 2
#define LOAD_REAL(array, axis) leaf->array[AXIS_##axis]
#define HOLDING(mask) ((uint)(mask))
#endif

/// Where a ray meets the planes of the triangles of a leaf.
typedef struct Crossing {
    real_t t, u, v;
} Crossing;

/// Bit i of the result says that triangle i is hit with t_min < t <= t_max; then lane i of *crossing holds where.
/// Triangles whose two edges are parallel or zero are never hit: the two products in each component of the normal are
/// then equal and rounded alike, so the normal is exactly zero, and so is the determinant.
INLINE uint ray_triangle(const LocalRay* ray, global const leaf_t* leaf, float t_min, float t_max,
                         Crossing* crossing) {
    const real_t edge1_x = LOAD_REAL(edge1, x), edge1_y = LOAD_REAL(edge1, y), edge1_z = LOAD_REAL(edge1, z);
    const real_t edge2_x = LOAD_REAL(edge2, x), edge2_y = LOAD_REAL(edge2, y), edge2_z = LOAD_REAL(edge2, z);
    const real_t direction_x = ray->direction.x, direction_y = ray->direction.y, direction_z = ray->direction.z;
    const real_t to_v0_x = LOAD_REAL(v0, x) - ray->origin.x;
    const real_t to_v0_y = LOAD_REAL(v0, y) - ray->origin.y;
    const real_t to_v0_z = LOAD_REAL(v0, z) - ray->origin.z;

    // normal = edge1 x edge2, without fma: see above.
    const real_t normal_x = edge1_y * edge2_z - edge1_z * edge2_y;
    const real_t normal_y = edge1_z * edge2_x - edge1_x * edge2_z;
    const real_t normal_z = edge1_x * edge2_y - edge1_y * edge2_x;
    const real_t determinant = fma(direction_x, normal_x, fma(direction_y, normal_y, direction_z * normal_z));

    // The weights times the determinant are -/+ edge . (to_v0 x direction); compared by sign before any division.
    const real_t side_x = fma(to_v0_y, direction_z, -(to_v0_z * direction_y));
    const real_t side_y = fma(to_v0_z, direction_x, -(to_v0_x * direction_z));
    const real_t side_z = fma(to_v0_x, direction_y, -(to_v0_y * direction_x));
    const real_t sign = copysign((real_t)(1.0f), determinant);
    const real_t scaled_u = sign * fma(edge2_x, side_x, fma(edge2_y, side_y, edge2_z * side_z));
    const real_t scaled_v = -sign * fma(edge1_x, side_x, fma(edge1_y, side_y, edge1_z * side_z));
    const real_t size = fabs(determinant);
    const uint inside =
        HOLDING((scaled_u >= 0.0f) & (scaled_v >= 0.0f) & (scaled_u + scaled_v <= size) & (size > 0.0f));
    if (inside == 0) return 0;

    // The normal is divided first, so that no product of three lengths is formed. Where that overflows or gives NaN,
    // t is not in (t_min, t_max], as t_max is finite.
    const real_t inverse = 1.0f / determinant;
    crossing->t = fma(to_v0_x, normal_x * inverse,
                      fma(to_v0_y, normal_y * inverse, to_v0_z * (normal_z * inverse)));
    crossing->u = scaled_u * fabs(inverse);
    crossing->v = scaled_v * fabs(inverse);
    return inside & HOLDING((crossing->t > t_min) & (crossing->t <= t_max));
}

#endif
