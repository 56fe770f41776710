// SPDX-License-Identifier: MIT
// Ray against the oriented box of a child: the ray goes into the box's frame, where the three slabs are the lanes of a
// vector (dissertation 3.2). The test is conservative and boxes are closed.
#ifndef BOXWOOD_TRAVERSE_RAY_OBB_H
#define BOXWOOD_TRAVERSE_RAY_OBB_H
#include "shared/node.h"
#include "traverse/local_ray.h"

// What the frame costs in digits, for any rows A, orthonormal or not. Let u = 2^-24, D = origin - center,
// o_k = sum_j A_kj D_j and d_k = sum_j A_kj direction_j, and the weights S_k = sum_j |A_kj D_j|,
// T_k = sum_j |A_kj direction_j|. Computed as below, o_k is off by at most 4u S_k (the difference, a product, two more
// roundings), d_k by 3u T_k, and the computed weights are short by at most 4u of themselves (Higham, gamma_n).
//
// - The error of o_k moves the slab: the extent becomes e_k + 4u S_k, and 3u of that sum for the roundings that add it
//   up. 8u of each part are added.
// - The error of d_k makes the speed along axis k a range, |d_k| -/+ 3u T_k, and u of it for the rounding of the sums,
//   at most u T_k. 8u T_k are taken off and put on. The ray enters at the highest speed and leaves at the lowest; where
//   that is not positive the direction has no sign, and the ray is taken to come towards the slab and never to leave
//   it.
// - Products below the normal range lose up to 2^-126 each (2^-150 where denormals are kept), three in each sum: 2^-123
//   is added. For T_k it is at most T_k, so that a direction of exactly zero stays one: inside the slab it never limits
//   the ray (0 / 0 = NaN on the face, which is ignored), outside it never enters.
// - The quotient takes a rounding of its numerator (u), one of the factor's product (u) and one of the division
//   (2.5 ulp <= 5u), and the distance of a hit is off by 8u: the factor 1 -/+ 20u of local_ray.h is enough, as there.
//   It is on the numerator, so that an entry overflows only where the exact one does.
// - A hit lies beside the ray by 2u of its way, along every axis (ray_triangle.h), which the 8u T_k have room for, and
//   by some of its triangle's extent, which the boxes are padded by (hit_error, volumes/obb_node.h).
//
// What overflows, or is NaN for that, is an infinite extent or a candidate that is ignored: no hit is lost. A false hit
// is one of a box whose slab k is wider by at most 2^-20 (e_k + S_k + t T_k) and 2^-122 where the ray meets it.
#define FRAME_SLACK 0x1p-21f
#define FRAME_UNDERFLOW 0x1p-123f

/// Where the ray is inside one box within [t_min, t_max]: from *entry on. False when nowhere. `volume` is that of an
/// OrientedNode whose child is not aligned.
INLINE bool ray_obb(const LocalRay* ray, global const float* volume, float t_min, float t_max, float* entry) {
    // The last lane of each vector is a neighbour in `volume` and goes nowhere: three floats cost more to load than
    // four.
    const float4 center = vload4(0, volume);
    const float4 extent = vload4(0, volume + 3);
    const float4 column_x = vload4(0, volume + 6);
    const float4 column_y = vload4(0, volume + 9);
    const float4 column_z = vload4(0, volume + 11).yzwx;
    const float3 from_center = ray->origin - center.xyz;
    const float3 direction = ray->direction;

    const float4 position =
        fma(column_x, (float4)(from_center.x), fma(column_y, (float4)(from_center.y), column_z * from_center.z));
    const float4 speed =
        fma(column_x, (float4)(direction.x), fma(column_y, (float4)(direction.y), column_z * direction.z));
    const float4 size_x = fabs(column_x), size_y = fabs(column_y), size_z = fabs(column_z);
    const float4 position_weight = fma(size_x, (float4)(fabs(from_center.x)),
                                       fma(size_y, (float4)(fabs(from_center.y)), size_z * fabs(from_center.z)));
    const float4 speed_weight =
        fma(size_x, (float4)(fabs(direction.x)), fma(size_y, (float4)(fabs(direction.y)), size_z * fabs(direction.z)));

    const float4 reach = fma(position_weight, (float4)(FRAME_SLACK),
                             fma(extent, (float4)(1.0f + FRAME_SLACK), (float4)(FRAME_UNDERFLOW)));
    const float4 doubt = fma(speed_weight, (float4)(FRAME_SLACK), LESSER(speed_weight, (float4)(FRAME_UNDERFLOW)));
    const float4 highest = fabs(speed) + doubt;
    const float4 lowest = fabs(speed) - doubt;
    const int4 is_parallel = lowest <= 0.0f;
    // Along the direction; towards the slab when that is in doubt.
    const float4 ahead = select(select(position, -position, speed < 0.0f), -fabs(position), is_parallel);
    const float4 entries = (-reach - ahead) * (1.0f - BOX_SLACK) / highest;
    const float4 exits = (reach - ahead) * (1.0f + BOX_SLACK) / select(lowest, (float4)(0.0f), is_parallel);
    float first = GREATER(entries.x, t_min);
    first = GREATER(entries.y, first);
    first = GREATER(entries.z, first);
    float last = LESSER(exits.x, t_max);
    last = LESSER(exits.y, last);
    last = LESSER(exits.z, last);
    *entry = first;
    return first <= last;
}

#endif
