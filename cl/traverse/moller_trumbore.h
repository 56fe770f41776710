// SPDX-License-Identifier: MIT
// Ray against triangle after Moller and Trumbore (1997), from the vertices and without any epsilon: what the watertight
// test of ray_triangle.h is compared with. Neighbours round their shared edge differently, so rays may pass between
// them or hit both; and as boxes are padded for the watertight test only, a hit may depend on the boxes.
#ifndef BOXWOOD_TRAVERSE_MOLLER_TRUMBORE_H
#define BOXWOOD_TRAVERSE_MOLLER_TRUMBORE_H
#include "traverse/leaf.h"
#include "traverse/local_ray.h"

/// Nothing is worked out beforehand.
typedef struct Shear {
    int none;
} Shear;

INLINE void make_shear(const LocalRay* ray, Shear* shear) {
    (void)ray;
    shear->none = 0;
}

/// As ray_triangle of ray_triangle.h. Triangles whose two edges are parallel or zero are never hit: the two products in
/// each component of the normal are then equal and rounded alike, so the normal is exactly zero, and so is the
/// determinant.
INLINE uint ray_triangle(const LocalRay* ray, const Shear* shear, global const leaf_t* leaf, float t_min, float t_max,
                         TriangleHit* hit) {
    (void)shear;
    const real_t v0_x = COORDINATE(0, 0), v0_y = COORDINATE(0, 1), v0_z = COORDINATE(0, 2);
    const real_t edge1_x = COORDINATE(1, 0) - v0_x, edge1_y = COORDINATE(1, 1) - v0_y,
                 edge1_z = COORDINATE(1, 2) - v0_z;
    const real_t edge2_x = COORDINATE(2, 0) - v0_x, edge2_y = COORDINATE(2, 1) - v0_y,
                 edge2_z = COORDINATE(2, 2) - v0_z;
    const real_t direction_x = ray->direction.x, direction_y = ray->direction.y, direction_z = ray->direction.z;
    const real_t to_v0_x = v0_x - ray->origin.x;
    const real_t to_v0_y = v0_y - ray->origin.y;
    const real_t to_v0_z = v0_z - ray->origin.z;

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
    hit->t = fma(to_v0_x, normal_x * inverse, fma(to_v0_y, normal_y * inverse, to_v0_z * (normal_z * inverse)));
    hit->u = scaled_u * fabs(inverse);
    hit->v = scaled_v * fabs(inverse);
    return inside & HOLDING((hit->t > t_min) & (hit->t <= t_max));
}

#endif
