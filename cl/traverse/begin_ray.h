// SPDX-License-Identifier: MIT
// From the caller's ray to the one that is traced, and from its distances back to the caller's.
#ifndef BOXWOOD_TRAVERSE_BEGIN_RAY_H
#define BOXWOOD_TRAVERSE_BEGIN_RAY_H
#include "traverse/far_origin.h"
#include "traverse/local_ray.h"

// The scene's radius is traced as a length from 2^30 on, below 2^31.
#define LENGTH_EXPONENT 30

/// Distances along the traced ray are those of the caller times 2^exponent, less `moved`.
typedef struct Units {
    int exponent;
    int direction; ///< The traced direction has its largest component from 2^direction on, below twice that.
    TwoFloats moved;
} Units;

/// True when the ray is one that may hit something; see Ray.
INLINE bool is_valid_ray(float4 origin, float4 direction) {
    const float t_min = origin.w;
    const float t_max = direction.w;
    const float4 without_t_max = (float4)(direction.xyz, 0.0f);
    const uint finite = lanes4((fabs(origin) <= FLT_MAX) & (fabs(without_t_max) <= FLT_MAX));
    const uint moving = lanes4(without_t_max != 0.0f);
    return finite == 15 && moving != 0 && t_min >= 0.0f && t_min <= t_max;
}

/// Sets up the ray in world space, and the interval of its distances in which hits lie: *t_min excluded, *t_max, which is finite,
/// included. False when the ray cannot hit anything.
///
/// The direction is scaled by a power of two to about the scene's radius, so that distances are near 1 and no product in traversal
/// over- or underflows because a direction is long or short, or a scene large or small. Powers of two change no digit.
INLINE bool begin_ray(global const Ray* source, const SceneSphere* sphere, LocalRay* ray, Units* units, float* t_min,
                      float* t_max) {
    const float4 origin = vload4(0, source->origin);
    const float4 direction = vload4(0, source->direction);
    if (!is_valid_ray(origin, direction)) return false;
    const int size = (int)(as_uint(sphere->radius) >> 23) - 127;
    const int length = exponent_of(direction.xyz);
    units->direction = clamp(size, -60, 60);
    units->exponent = length - units->direction;
    units->moved.high = 0.0f;
    units->moved.low = 0.0f;
    // Not negative zero, which orders behind all other distances on the stack.
    *t_min = scale_by(fabs(origin.w), units->exponent);
    // No hit at an infinite distance, in either unit: that is how a miss is written.
    *t_max = fmin(scale_by(fmin(direction.w, FLT_MAX), units->exponent), FLT_MAX);
    const float3 unit = direction.xyz * power_of_two(-min(length, 126));
    float3 start = origin.xyz;
    if (is_far(start, sphere)) {
        if (!move_origin(sphere, unit, &start, &units->moved)) return false;
        const float to_traced = power_of_two(-units->direction);
        units->moved.high *= to_traced;
        units->moved.low *= to_traced;
        *t_min = fmax((*t_min - units->moved.high) - units->moved.low, 0.0f);
        *t_max = (*t_max - units->moved.high) - units->moved.low;
        if (!(*t_max >= 0.0f)) return false;
    }
    make_local_ray(start, unit * power_of_two(units->direction), LENGTH_EXPONENT - size, ray);
    return true;
}

/// The caller's distance of a hit at `t` along the traced ray: never outside of the caller's interval, even where it rounds there.
INLINE float caller_distance(global const Ray* source, const Units* units, float t) {
    const float distance = scale_by(units->moved.high + (units->moved.low + t), -units->exponent);
    const float least = as_float(as_uint(fabs(source->t_min)) + 1);
    return fmin(fmax(distance, least), source->t_max);
}

#endif
