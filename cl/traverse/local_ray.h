// SPDX-License-Identifier: MIT
// A ray in one space (world, or the object space of an instance), with precomputed values for the box test.
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
    /// -1 / direction, for the planes where the ray enters; magnitude at most the exact one.
    float3 minus_near_inverse;
    float3 minus_far_inverse; ///< The same for the planes where it leaves; magnitude at least the exact one.
    /// Bytes from a wide8 node's first row to those of the planes where the ray enters, of the other planes but for bit
    /// 5.
    size_t near_x, near_y, near_z;
    int exponent; ///< Of lengths, for the triangle test; see make_shear.
} LocalRay;

// How far the inverses are moved; why no box is missed is in ray_triangle.h. Let u = 2^-24. A slab distance
// fl(origin - plane) * -inverse takes a rounding of the reciprocal (2.5 ulp <= 5u by the OpenCL standard), one of its
// product with the factor below (u) and one of the last product (u): 7u. The distance of a hit is off by at most 9u of
// itself, a part of the triangle's size apart for which boxes are padded. A factor of 1 -/+ 20u therefore makes every
// entry distance at most, and every exit distance at least, that of any hit in the box, terms of second order included.
// A negative entry distance moves up, towards 0, but never past: that is harmless, as t_min >= 0; a negative exit
// distance moves further down, which is a miss either way.
#define BOX_SLACK 0x1.4p-20f

/// 2^exponent, for -126 to 127.
INLINE float power_of_two(int exponent) { return as_float((uint)(exponent + 127) << 23); }

/// 1 / power, for powers of two from 2^-126 to 2^126.
INLINE float inverse_of_power(float power) { return as_float(0x7f000000u - as_uint(power)); }

/// The bits of the magnitudes of x, y and z, which order as these do, but faster; 0 for w.
INLINE uint4 magnitudes(float4 v) { return as_uint4(v) & (uint4)(0x7fffffff, 0x7fffffff, 0x7fffffff, 0); }

/// The largest lane, in all lanes.
INLINE uint4 largest_of(uint4 bits) {
    const uint4 of_two = max(bits, bits.yxwz);
    return max(of_two, of_two.zwxy);
}

/// The bits of the power of two of positive numbers, by their bits; at least that of 2^-126. (Integer min, max and
/// clamp with a scalar as the bound of a vector go wrong in Oclgrind 21.10.)
INLINE uint4 power_bits(uint4 bits) { return max(bits & 0x7f800000u, (uint4)(0x00800000u)); }

/// inverse_of_power in each lane, of powers as bits.
INLINE float4 inverse_of_power_bits(uint4 power) { return as_float4(0x7f000000u - power); }

/// The exponent of a positive number's power of two, by its bits; at least -126.
INLINE int exponent_of(uint bits) { return (int)max(bits >> 23, 1u) - 127; }

/// A zero direction gives infinity for both inverses: its slab then never limits the ray inside (-inf to +inf, and
/// 0 * inf = NaN on the faces, which the box test ignores), and rejects it outside; -0 does so as a direction downward.
/// A direction so small that its reciprocal overflows has a finite, smaller one for entering.
INLINE void make_local_ray(float3 origin, float3 direction, int exponent, LocalRay* ray) {
    // Four lanes, the last one anything: three cost more.
    const float4 wide = as_float4(direction);
    const float4 inverse = -1.0f / wide;
    const float4 finite = max(min(inverse * (1.0f - BOX_SLACK), FLT_MAX), -FLT_MAX);
    const uint4 near_rows = (as_uint4(wide) >> 31) << 5 | (uint4)(0, 64, 128, 0);
    ray->origin = origin;
    ray->direction = direction;
    ray->minus_near_inverse = select(finite, inverse, wide == 0.0f).xyz;
    ray->minus_far_inverse = (inverse * (1.0f + BOX_SLACK)).xyz;
    ray->near_x = near_rows.x;
    ray->near_y = near_rows.y;
    ray->near_z = near_rows.z;
    ray->exponent = exponent;
}

/// Row `row` of the linear part of an affine map applied to a vector.
INLINE float map_vector(global const float* matrix, uint row, float3 d) {
    const float4 m = vload4(row, matrix);
    return fma(m.x, d.x, fma(m.y, d.y, m.z * d.z));
}

/// The exponent by which a matrix makes lengths larger, at most.
INLINE int growth(global const float* matrix) {
    const float4 row0 = vload4(0, matrix), row1 = vload4(1, matrix), row2 = vload4(2, matrix);
    return exponent_of(largest_of(max(magnitudes(row0), max(magnitudes(row1), magnitudes(row2)))).x);
}

/// The ray in the object space of an instance. The direction is not normalised, so t means the same in every space. The
/// instance's place is subtracted first, which far from the world's origin keeps the digits that the translation of
/// to_object has lost.
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
