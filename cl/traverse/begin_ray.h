// SPDX-License-Identifier: MIT
// Converts the caller's ray to the one that is traced, and distances along that back to the caller's.
#ifndef BOXWOOD_TRAVERSE_BEGIN_RAY_H
#define BOXWOOD_TRAVERSE_BEGIN_RAY_H
#include "traverse/far_origin.h"
#include "traverse/local_ray.h"

// The scene's radius is traced as a length from 2^30 on, below 2^31.
#define LENGTH_EXPONENT 30

/// From distances along the traced ray to those of the caller: plus `moved`, times `inverse`.
typedef struct Units {
    float inverse; ///< A power of two, from 2^-126 to 2^126.
    float length;  ///< A power of two: the traced direction's largest component is from there on, below twice that.
    TwoFloats moved;
} Units;

/// What begin_ray does where the ray is not one that starts near the scene: moves the start there. False where nothing
/// can be hit, as by rays that are not valid. `largest`: bits of the direction's largest magnitude.
INLINE bool begin_far(const SceneSphere* sphere, float4 origin, float4 direction, uint largest, float3* start,
                      Units* units, float* t_min, float* t_max) {
    if (largest == 0 || largest >= 0x7f800000u || !(origin.w >= 0.0f && origin.w <= direction.w)) return false;
    if (lanes4(fabs(origin) <= FLT_MAX) != 15) return false;
    const float3 unit = direction.xyz * power_of_two(-min(exponent_of(largest), 126));
    float3 moved_start = origin.xyz;
    TwoFloats moved;
    if (!move_origin(*sphere, unit, &moved_start, &moved)) return false;
    *start = moved_start;
    units->moved.high = moved.high * inverse_of_power(units->length);
    units->moved.low = moved.low * inverse_of_power(units->length);
    *t_min = fmax((*t_min - units->moved.high) - units->moved.low, 0.0f);
    *t_max = (*t_max - units->moved.high) - units->moved.low;
    return *t_max >= 0.0f;
}

/// Sets up the ray in world space, and the interval of its distances in which hits lie: *t_min excluded, *t_max, which
/// is finite, included. False when the ray cannot hit anything, as one that is not valid; see Ray.
///
/// The direction is scaled by a power of two to about the scene's radius, so that distances are near 1 and no product
/// in traversal over- or underflows because a direction is long or short, or a scene large or small. Powers of two
/// change no digit.
INLINE bool begin_ray(global const Ray* source, const SceneSphere* sphere, LocalRay* ray, Units* units, float* t_min,
                      float* t_max) {
    const float4 origin = vload4(0, source->origin);
    const float4 direction = vload4(0, source->direction);
    const uint4 largest = largest_of(magnitudes(direction));
    // What is valid and near, at once: the last lane is t_min, within 0 and t_max.
    const float reach = BOXWOOD_NEAR_RADII * sphere->radius;
    const float4 from_center = origin - (float4)(sphere->center[0], sphere->center[1], sphere->center[2], 0.0f);
    const int4 is_near = (from_center >= (float4)(-reach, -reach, -reach, 0.0f)) &
                         (from_center <= (float4)(reach, reach, reach, direction.w)) & (as_float4(largest) > 0.0f) &
                         (as_float4(largest) <= FLT_MAX);

    const int size = (int)(as_uint(sphere->radius) >> 23) - 127;
    const int target = clamp(size, -60, 60);
    // Powers of two as their bits, all lanes alike: faster than in scalars.
    const uint4 length = power_bits(largest);
    const uint4 least = (uint4)((uint)max(target + 1, 1) << 23), greatest = (uint4)((uint)(target + 253) << 23);
    const uint4 factor = clamp(length, least, greatest) - ((uint)target << 23);
    const float4 inverse = inverse_of_power_bits(factor);
    units->inverse = inverse.x;
    units->length = as_float((length.x - factor.x) + 0x3f800000u);
    units->moved.high = 0.0f;
    units->moved.low = 0.0f;
    // Not negative zero, which orders behind all other distances on the stack.
    *t_min = fabs(origin.w) * as_float(factor.x);
    // No hit at an infinite distance, in either unit: that is how a miss is written.
    *t_max = fmin(fmin(direction.w, FLT_MAX) * as_float(factor.x), FLT_MAX);
    float3 start = origin.xyz;
    if (lanes4(is_near) != 15 && !begin_far(sphere, origin, direction, largest.x, &start, units, t_min, t_max))
        return false;
    make_local_ray(start, (direction * inverse).xyz, LENGTH_EXPONENT - size, ray);
    return true;
}

/// The caller's distance of a hit at `t` along the traced ray: never outside of the caller's interval, even where it
/// rounds there.
INLINE float caller_distance(global const Ray* source, const Units* units, float t) {
    const float distance = (units->moved.high + (units->moved.low + t)) * units->inverse;
    const float least = as_float(as_uint(fabs(source->t_min)) + 1);
    return LESSER(GREATER(distance, least), source->t_max);
}

#endif
