// SPDX-License-Identifier: MIT
// Records of floats as tests lay them out: component k of record i is at k * count + i. LANES of them are read and
// written from record `at` on; `count` is a multiple of LANES.
#ifndef BOXWOOD_TESTS_LANES_OF_H
#define BOXWOOD_TESTS_LANES_OF_H
#include "runtime/vector.h"

INLINE void load_components(global const float* in, uint count, uint at, real* values, uint size) {
    for (uint k = 0; k < size; ++k) values[k] = LOAD_LANES(in + k * count + at);
}

INLINE void store_components(const real* values, global float* out, uint count, uint at, uint size) {
    for (uint k = 0; k < size; ++k) STORE_LANES(values[k], out + k * count + at);
}

INLINE void load_rows(global const float* in, uint count, uint at, Frame* frame) {
    real v[9];
    load_components(in, count, at, v, 9);
    const Frame rows = {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8]}};
    *frame = rows;
}

INLINE void store_rows(const Frame* frame, global float* out, uint count, uint at) {
    const real v[9] = {frame->a.x, frame->a.y, frame->a.z, frame->b.x, frame->b.y,
                       frame->b.z, frame->c.x, frame->c.y, frame->c.z};
    store_components(v, out, count, at, 9);
}

#endif
