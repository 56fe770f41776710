// SPDX-License-Identifier: MIT
// A ray in one space (world, or the object space of an instance), with what the tests of boxes and triangles need worked out
// once.
#ifndef BOXWOOD_TRAVERSE_LOCAL_RAY_H
#define BOXWOOD_TRAVERSE_LOCAL_RAY_H
#include "runtime/lanes.h"
#include "runtime/numerics.h"
#include "shared/instance.h"
#include "shared/ray.h"

/// What the triangle test needs of a ray; see ray_triangle.h. The axes are numbered so that z is the one along which the ray
/// is fastest.
typedef struct Shear {
    uint x, y, z;
    float origin_x, origin_y, origin_z;
    float direction_x, direction_y, direction_z; ///< Times a power of two; see make_shear.
    float scale;                                 ///< A power of two: along z, lengths times it over `depth` are distances.
    float depth;
} Shear;

typedef struct LocalRay {
    float3 origin;
    float3 direction;
    // Negative, so that a box's planes are subtracted from the origin: straight from memory, without a load before.
    float3 minus_near_inverse; ///< -1 / direction, for the planes where the ray enters; magnitude at most the exact one.
    float3 minus_far_inverse;  ///< The same for the planes where it leaves; magnitude at least the exact one.
    Shear shear;
    int exponent; ///< Of lengths, see make_shear.
} LocalRay;

// How far the inverses are moved; why no box is missed is in ray_triangle.h. Let u = 2^-24. A slab distance
// fl(origin - plane) * -inverse takes a rounding of the reciprocal (2.5 ulp <= 5u by the OpenCL standard), one of its product
// with the factor below (u) and one of the last product (u): 7u. The distance of a hit is off by at most 7u of itself, a part of
// the triangle's size apart for which boxes are padded. A factor of 1 -/+ 16u therefore makes every entry distance at most,
// and every exit distance at least, that of any hit in the box, terms of second order included. A negative entry distance moves up,
// towards 0, but never past: that is harmless, as t_min >= 0; a negative exit distance moves further down, which is a miss either
// way.
#define BOX_SLACK 0x1p-20f

/// 2^exponent, for -126 to 127.
INLINE float power_of_two(int exponent) { return as_float((uint)(exponent + 127) << 23); }

/// value * 2^exponent for any exponent within +-250: by halves, so that nothing is lost on the way to a value in range.
INLINE float scale_by(float value, int exponent) {
    const int half_way = exponent / 2;
    return value * power_of_two(half_way) * power_of_two(exponent - half_way);
}

/// The exponent of the largest component's power of two; at least -126.
INLINE int exponent_of(float3 v) {
    const float largest = max(fabs(v.x), max(fabs(v.y), fabs(v.z)));
    return (int)max(as_uint(largest) >> 23, 1u) - 127;
}

/// For the triangle test: the direction is scaled by a power of two to a largest component from 1 to 2, and lengths by 2^exponent,
/// which makes all that there is in the space at most some 2^35 long, so that products of three lengths neither over- nor underflow,
/// however large or small the scene is.
INLINE void make_shear(float3 origin, float3 direction, int exponent, Shear* shear) {
    const float3 size = fabs(direction);
    const bool is_z = size.z >= size.x && size.z >= size.y;
    const bool is_y = !is_z && size.y >= size.x;
    shear->scale = power_of_two(clamp(exponent, -126, 126));
    const float3 scaled = direction * power_of_two(-min(exponent_of(direction), 126)) * shear->scale;
    shear->x = is_z ? 0 : is_y ? 2 : 1;
    shear->y = is_z ? 1 : is_y ? 0 : 2;
    shear->z = is_z ? 2 : is_y ? 1 : 0;
    shear->origin_x = is_z ? origin.x : is_y ? origin.z : origin.y;
    shear->origin_y = is_z ? origin.y : is_y ? origin.x : origin.z;
    shear->origin_z = is_z ? origin.z : is_y ? origin.y : origin.x;
    shear->direction_x = is_z ? scaled.x : is_y ? scaled.z : scaled.y;
    shear->direction_y = is_z ? scaled.y : is_y ? scaled.x : scaled.z;
    shear->direction_z = is_z ? scaled.z : is_y ? scaled.y : scaled.x;
    shear->depth = (is_z ? direction.z : is_y ? direction.y : direction.x) * shear->scale;
}

/// A zero direction gives infinity for both inverses: its slab then never limits the ray inside (-inf to +inf, and
/// 0 * inf = NaN on the faces, which the box test ignores), and rejects it outside. A direction so small that its
/// reciprocal overflows has a finite, smaller one for entering. Components below 2^-90 of the largest are taken for zero, here and in
/// the triangle test, so that none is left whose products underflow.
INLINE void make_local_ray(float3 origin, float3 direction, int exponent, LocalRay* ray) {
    const float least = max(fabs(direction.x), max(fabs(direction.y), fabs(direction.z))) * 0x1p-90f;
    ray->direction = select(direction, (float3)(0.0f), fabs(direction) < least);
    const float3 inverse = -1.0f / ray->direction;
    const float3 near_inverse = clamp(inverse * (1.0f - BOX_SLACK), -FLT_MAX, FLT_MAX);
    const float3 far_inverse = inverse * (1.0f + BOX_SLACK);
    const float3 parallel = (float3)(-INFINITY);
    ray->origin = origin;
    ray->minus_near_inverse = select(near_inverse, parallel, ray->direction == 0.0f);
    ray->minus_far_inverse = select(far_inverse, parallel, ray->direction == 0.0f);
    ray->exponent = exponent;
    make_shear(origin, ray->direction, exponent, &ray->shear);
}

/// Row `row` of the linear part of an affine map applied to a vector.
INLINE float map_vector(global const float* matrix, uint row, float3 d) {
    const float4 m = vload4(row, matrix);
    return fma(m.x, d.x, fma(m.y, d.y, m.z * d.z));
}

/// The exponent by which a matrix makes lengths larger, at most.
INLINE int growth(global const float* matrix) {
    const float4 row0 = fabs(vload4(0, matrix)), row1 = fabs(vload4(1, matrix)), row2 = fabs(vload4(2, matrix));
    return exponent_of(max(row0.xyz, max(row1.xyz, row2.xyz)));
}

/// The ray in the object space of an instance. The direction is not normalised, so t means the same in every space. The instance's place
/// is subtracted first, which far from the world's origin keeps the digits that the translation of to_object has lost.
INLINE void to_object_space(const LocalRay* ray, global const InstanceRecord* instance, LocalRay* local_ray) {
    global const float* m = instance->to_object;
    global const float* w = instance->to_world;
    const float3 p = ray->origin - (float3)(w[3], w[7], w[11]);
    const float3 d = ray->direction;
    make_local_ray((float3)(map_vector(m, 0, p), map_vector(m, 1, p), map_vector(m, 2, p)),
                   (float3)(map_vector(m, 0, d), map_vector(m, 1, d), map_vector(m, 2, d)), ray->exponent - growth(m),
                   local_ray);
}

#endif
