// SPDX-License-Identifier: MIT
// A ray in one space (world, or the object space of an instance), with what the box test needs worked out once.
#ifndef BOXWOOD_TRAVERSE_LOCAL_RAY_H
#define BOXWOOD_TRAVERSE_LOCAL_RAY_H
#include "runtime/lanes.h"
#include "runtime/numerics.h"
#include "shared/instance.h"
#include "shared/ray.h"

typedef struct LocalRay {
    float3 origin;
    float3 direction;
    // Negative, so that a box's planes are subtracted from the origin: straight from memory, without a load before.
    float3 minus_near_inverse; ///< -1 / direction, for the planes where the ray enters; magnitude at most the exact one.
    float3 minus_far_inverse;  ///< The same for the planes where it leaves; magnitude at least the exact one.
} LocalRay;

// How far the inverses are moved. Let u = 2^-24. A slab distance (origin - plane) * -inverse takes a rounding of the
// difference (u), one of the reciprocal (2.5 ulp <= 5u by the OpenCL standard), one of the reciprocal's product with the
// factor below (u) and one of the last product (u): 8u, and terms of second order below u. A factor of 1 -/+ 16u
// therefore makes every entry distance at most, and every exit distance at least, the exact one, with 7u left for the
// rounding of the hit distance that it is compared with. A negative entry distance moves up, towards 0, but never past:
// that is harmless, as t_min >= 0; a negative exit distance moves further down, which is a miss either way.
#define BOX_SLACK 0x1p-20f

/// A zero direction gives infinity for both inverses: its slab then never limits the ray inside (-inf to +inf, and
/// 0 * inf = NaN on the faces, which the box test ignores), and rejects it outside. A direction so small that its
/// reciprocal overflows has a finite, smaller one for entering.
INLINE void make_local_ray(float3 origin, float3 direction, LocalRay* ray) {
    const float3 inverse = -1.0f / direction;
    const float3 near_inverse = clamp(inverse * (1.0f - BOX_SLACK), -FLT_MAX, FLT_MAX);
    const float3 far_inverse = inverse * (1.0f + BOX_SLACK);
    const float3 parallel = (float3)(-INFINITY);
    ray->origin = origin;
    ray->direction = direction;
    ray->minus_near_inverse = select(near_inverse, parallel, direction == 0.0f);
    ray->minus_far_inverse = select(far_inverse, parallel, direction == 0.0f);
}

/// Row `row` of an affine map applied to a point.
INLINE float map_point(global const float* matrix, uint row, float3 p) {
    const float4 m = vload4(row, matrix);
    return fma(m.x, p.x, fma(m.y, p.y, fma(m.z, p.z, m.w)));
}

/// The same without the translation.
INLINE float map_direction(global const float* matrix, uint row, float3 d) {
    const float4 m = vload4(row, matrix);
    return fma(m.x, d.x, fma(m.y, d.y, m.z * d.z));
}

/// The ray in the object space of an instance. The direction is not normalised, so t means the same in every space.
INLINE void to_object_space(const LocalRay* ray, global const InstanceRecord* instance, LocalRay* local_ray) {
    global const float* m = instance->to_object;
    const float3 p = ray->origin;
    const float3 d = ray->direction;
    make_local_ray((float3)(map_point(m, 0, p), map_point(m, 1, p), map_point(m, 2, p)),
                   (float3)(map_direction(m, 0, d), map_direction(m, 1, d), map_direction(m, 2, d)), local_ray);
}

/// True when the ray is one that may hit something; see Ray.
INLINE bool is_valid_ray(float4 origin, float4 direction) {
    const float t_min = origin.w;
    const float t_max = direction.w;
    const float4 without_t_max = (float4)(direction.xyz, 0.0f);
    const uint finite = lanes4((fabs(origin) <= FLT_MAX) & (fabs(without_t_max) <= FLT_MAX));
    const uint moving = lanes4(without_t_max != 0.0f);
    return finite == 15 && moving != 0 && t_min >= 0.0f && t_min <= t_max;
}

/// The exponent, as float stores it, of the power of two that the direction is divided by. That brings its largest
/// component to about 1 (to [2^-23, 4) at the extremes of float), so that no product in traversal over- or underflows
/// because a direction is long or short. Distances along the scaled ray are t times the same power, exactly.
INLINE uint direction_exponent(float4 direction) {
    const float largest = max(fabs(direction.x), max(fabs(direction.y), fabs(direction.z)));
    return clamp(as_uint(largest) >> 23, 1u, 253u);
}

#endif
