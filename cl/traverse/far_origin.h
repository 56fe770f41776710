// SPDX-License-Identifier: MIT
// Moves the origins of rays from far away close to the scene. Rounding errors grow with the distance of the origin, and
// with them the number of boxes that a ray has to visit; from a point of the ray near the scene neither happens.
#ifndef BOXWOOD_TRAVERSE_FAR_ORIGIN_H
#define BOXWOOD_TRAVERSE_FAR_ORIGIN_H
#include "runtime/inline.h"
#include "runtime/numerics.h"
#include "shared/scene_sphere.h"

/// A number as the sum of two floats, the second a rounding of the first.
typedef struct TwoFloats {
    float high, low;
} TwoFloats;

/// a + b without rounding (Knuth).
INLINE TwoFloats two_sum(float a, float b) {
    const float sum = a + b;
    const float taken = sum - a;
    const TwoFloats result = {sum, (a - (sum - taken)) + (b - taken)};
    return result;
}

/// a + b c: the product and the sum with `high` are exact, the rest rounds at 2^-48 of what is added.
INLINE TwoFloats add_scaled(TwoFloats a, float b, float c) {
    const float product = b * c;
    const TwoFloats sum = two_sum(a.high, product);
    return two_sum(sum.high, a.low + (sum.low + fma(b, c, -product)));
}

/// Moves the origin along `direction`, whose largest component is from 1 to 2, to two radii or more before the sphere's
/// center, and sets *distance to how far that was. False when the ray misses the sphere or leaves it behind.
///
/// Each step goes to where the ray is nearest to the center, less 2 radii / |direction|^2 times that; it misses that by
/// some 8u of the step (u = 2^-24) and, as steps are cut to 9 bits so that whole numbers stay whole, by 2^-8 of it: two
/// steps suffice from 1e4 radii, eight from anywhere. Position and distance are sums of two floats, whose roundings are
/// 2^-48 of a step: where it matters the moved origin is the exact point of the ray rounded once, off by u of its own
/// coordinates, as an origin given there would be.
static __attribute__((noinline)) bool move_origin(SceneSphere sphere, float3 direction, float3* origin,
                                                  TwoFloats* distance) {
    TwoFloats x = {origin->x, 0.0f}, y = {origin->y, 0.0f}, z = {origin->z, 0.0f};
    const float square = fma(direction.x, direction.x, fma(direction.y, direction.y, direction.z * direction.z));
    distance->high = 0.0f;
    distance->low = 0.0f;
    for (int i = 0; i < 16; ++i) {
        const float3 to_center =
            (float3)(sphere.center[0] - x.high, sphere.center[1] - y.high, sphere.center[2] - z.high);
        const float along =
            fma(to_center.x, direction.x, fma(to_center.y, direction.y, to_center.z * direction.z)) / square;
        const float step = as_float(as_uint(along - 2.0f * sphere.radius) & 0xffff8000u);
        if (i == 0 && !(step >= 0.0f)) return false;
        if (fabs(step) <= 0.25f * sphere.radius) break;
        x = add_scaled(x, step, direction.x);
        y = add_scaled(y, step, direction.y);
        z = add_scaled(z, step, direction.z);
        *distance = add_scaled(*distance, step, 1.0f);
    }
    *origin = (float3)(x.high, y.high, z.high);
    const float reach = BOXWOOD_NEAR_RADII * sphere.radius;
    return fabs(x.high - sphere.center[0]) <= reach && fabs(y.high - sphere.center[1]) <= reach &&
           fabs(z.high - sphere.center[2]) <= reach;
}

#endif
