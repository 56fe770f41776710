// SPDX-License-Identifier: MIT
// From the caller's ray to the one that is traced, and from its distances back to the caller's.
#ifndef BOXWOOD_TRAVERSE_BEGIN_RAY_H
#define BOXWOOD_TRAVERSE_BEGIN_RAY_H
#include "traverse/far_origin.h"
#include "traverse/local_ray.h"

// The scene's radius is traced as a length from 2^30 on, below 2^31.
#define LENGTH_EXPONENT 30

/// Distances along the traced ray are those of the caller times `factor`, less `moved`.
typedef struct Units {
    float factor; ///< A power of two, from 2^-126 to 2^126.
    float length; ///< A power of two: the traced direction's largest component is from there on, below twice that.
    TwoFloats moved;
} Units;

/// What begin_ray does where the origin is not near the scene: moves it there. False where nothing can be hit, as by rays that are not
/// finite.
INLINE bool begin_far(const SceneSphere* sphere, float4 origin, float4 unit, float3* start, Units* units, float* t_min,
                      float* t_max) {
    float3 moved_start = origin.xyz;
    TwoFloats moved;
    if (lanes4((fabs(origin) <= FLT_MAX) & (fabs(unit) <= FLT_MAX)) != 15) return false;
    if (!move_origin(*sphere, unit.xyz, &moved_start, &moved)) return false;
    *start = moved_start;
    units->moved.high = moved.high * inverse_of_power(units->length);
    units->moved.low = moved.low * inverse_of_power(units->length);
    *t_min = fmax((*t_min - units->moved.high) - units->moved.low, 0.0f);
    *t_max = (*t_max - units->moved.high) - units->moved.low;
    return *t_max >= 0.0f;
}

/// Sets up the ray in world space, and the interval of its distances in which hits lie: *t_min excluded, *t_max, which is finite,
/// included. False when the ray cannot hit anything, as one that is not valid; see Ray.
///
/// The direction is scaled by a power of two to about the scene's radius, so that distances are near 1 and no product in traversal
/// over- or underflows because a direction is long or short, or a scene large or small. Powers of two change no digit.
INLINE bool begin_ray(global const Ray* source, const SceneSphere* sphere, LocalRay* ray, Units* units, float* t_min,
                      float* t_max) {
    const float4 origin = vload4(0, source->origin);
    const float4 direction = vload4(0, source->direction);
    const float4 center = (float4)(sphere->center[0], sphere->center[1], sphere->center[2], 0.0f);
    const float reach = BOXWOOD_NEAR_RADII * sphere->radius;
    const float4 without_t_max = (float4)(direction.xyz, 0.0f);
    const uint near = lanes4((fabs(without_t_max) <= FLT_MAX) & (fabs(origin - center) <= (float4)(reach, reach, reach, FLT_MAX)));
    if (lanes4(without_t_max != 0.0f) == 0 || !(origin.w >= 0.0f && origin.w <= direction.w)) return false;

    const int size = (int)(as_uint(sphere->radius) >> 23) - 127;
    const int length = exponent_of(largest_of(magnitudes(direction.xyz)));
    const int factor = clamp(length - clamp(size, -60, 60), -126, 126);
    units->factor = power_of_two(factor);
    units->length = power_of_two(length - factor);
    units->moved.high = 0.0f;
    units->moved.low = 0.0f;
    // Not negative zero, which orders behind all other distances on the stack.
    *t_min = fabs(origin.w) * units->factor;
    // No hit at an infinite distance, in either unit: that is how a miss is written.
    *t_max = fmin(fmin(direction.w, FLT_MAX) * units->factor, FLT_MAX);
    float3 start = origin.xyz;
    if (near != 15 && !begin_far(sphere, origin, without_t_max * power_of_two(-min(length, 126)), &start, units, t_min, t_max))
        return false;
    make_local_ray(start, direction.xyz * inverse_of_power(units->factor), LENGTH_EXPONENT - size, ray);
    return true;
}

/// The caller's distance of a hit at `t` along the traced ray: never outside of the caller's interval, even where it rounds there.
INLINE float caller_distance(global const Ray* source, const Units* units, float t) {
    const float distance = (units->moved.high + (units->moved.low + t)) * inverse_of_power(units->factor);
    const float least = as_float(as_uint(fabs(source->t_min)) + 1);
    return LESSER(GREATER(distance, least), source->t_max);
}

#endif
