// SPDX-License-Identifier: MIT
// Records of primitives as the top-down builder moves them: one vector with the bounds and, in the lane they leave
// free, the index.
//
// OWN_CENTRES  1: primitives are placed by `centres`, 3 floats each; 0: by the centres of their boxes
#ifndef BOXWOOD_BUILD_RECORD_H
#define BOXWOOD_BUILD_RECORD_H
#include "bounds/box.h"
#include "runtime/inline.h"
#include "runtime/numerics.h"

#if !defined(OWN_CENTRES)
#error "define OWN_CENTRES"
#endif

// Bounds in a vector: min x, y, z, unused, -max x, y, z, unused. One minimum joins two. A primitive's record is its
// bounds with its index in the first unused lane, as a number that arithmetic takes no detour for.
#define NO_BOUNDS ((float8)(INFINITY))
#define INDEX_MARK 0x40000000u

INLINE uint index_of(float8 record) { return as_uint(record.s3) & ~INDEX_MARK; }

/// The middle of a record's box; the last lane is 0.
INLINE float4 middle_of(float8 record) {
    const float4 middle = 0.5f * record.s0123 - 0.5f * record.s4567;
    return (float4)(middle.xyz, 0.0f);
}

INLINE float8 point_bounds(float4 point) { return (float8)(point, -point); }

INLINE float4 centre_of(float8 record, global const float* centres) {
#if OWN_CENTRES
    return (float4)(vload3(index_of(record), centres), 0.0f);
#else
    return middle_of(record);
#endif
}

#endif
