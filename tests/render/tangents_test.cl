// SPDX-License-Identifier: MIT
// compile: LANES=1
// compile: LANES=8
#include "bounds/lanes_of.h"
#include "render/tangents.h"

/// Tangent, bitangent and the direction itself.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void tangents_test(global const float* directions, global float* results, uint count) {
    const uint at = (uint)get_global_id(0) * LANES;
    if (at >= count) return;
    real d[3];
    load_components(directions, count, at, d, 3);
    Frame frame = {{d[0], d[0], d[0]}, {d[0], d[0], d[0]}, {d[0], d[1], d[2]}};
    tangents_of(&frame.c, &frame.a, &frame.b);
    store_rows(&frame, results, count, at);
}
