// SPDX-License-Identifier: MIT
// A box in registers, loaded and stored as two vectors (exactly six packed floats, nothing beyond them).
#ifndef BOXWOOD_BOUNDS_BOX_H
#define BOXWOOD_BOUNDS_BOX_H
#include "runtime/numerics.h"
#include "shared/aabb.h"

typedef struct Box {
    float4 a; ///< min x, y, z, max x
    float2 b; ///< max y, z
} Box;

inline Box load_box(global const Aabb* box) {
    global const float* floats = (global const float*)box;
    const Box result = {vload4(0, floats), vload2(2, floats)};
    return result;
}

inline void store_box(Box box, global Aabb* target) {
    global float* floats = (global float*)target;
    vstore4(box.a, 0, floats);
    vstore2(box.b, 2, floats);
}

/// Smallest box around both; exact, since min and max do not round.
inline Box hull(Box p, Box q) {
    const float4 low = LESSER(p.a, q.a);
    const float high = GREATER(p.a.w, q.a.w);
    const Box result = {(float4)(low.xyz, high), GREATER(p.b, q.b)};
    return result;
}

/// The centre, in lanes 0 to 2.
inline float4 box_centre(Box box) { return 0.5f * box.a + 0.5f * (float4)(box.a.w, box.b, box.a.w); }

inline float3 extent_of(Box box) { return (float3)(box.a.w, box.b) - box.a.xyz; }

#endif
