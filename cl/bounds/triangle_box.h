// SPDX-License-Identifier: MIT
// The box of a triangle in trees: padded to contain every point at which a ray may be reported to hit it.
#ifndef BOXWOOD_BOUNDS_TRIANGLE_BOX_H
#define BOXWOOD_BOUNDS_TRIANGLE_BOX_H
#include "runtime/numerics.h"
#include "shared/aabb.h"

// Of a triangle's longest extent D: 18u with u = 2^-24. traverse/ray_triangle.h derives 16u D, and 17u D where the
// roundings of the vertices' differences from the origin count too, as in oriented boxes, which are fitted to the
// corners of these boxes.
#define TRIANGLE_PAD 0x1.2p-20f

/// Planes moved outward by TRIANGLE_PAD of the longest extent at least: the difference itself rounds by u of the
/// coordinate, so 1.5u of that is taken off with it. A single point, which no ray hits, is its own box.
inline void padded_triangle_box(global const float* a, global const float* b, global const float* c, global Aabb* box) {
    float low[3], high[3], longest = 0.0f;
    for (int k = 0; k < 3; ++k) {
        low[k] = LESSER(LESSER(a[k], b[k]), c[k]);
        high[k] = GREATER(GREATER(a[k], b[k]), c[k]);
        longest = GREATER(high[k] - low[k], longest);
    }
    const float last_place = longest > 0.0f ? 1.5f * 0x1p-24f : 0.0f;
    for (int k = 0; k < 3; ++k) {
        box->min[k] = low[k] - fma(fabs(low[k]), last_place, TRIANGLE_PAD * longest);
        box->max[k] = high[k] + fma(fabs(high[k]), last_place, TRIANGLE_PAD * longest);
    }
}

#endif
