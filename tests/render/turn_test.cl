// SPDX-License-Identifier: MIT
// compile: LANES=1
// compile: LANES=8
#include "bounds/lanes_of.h"
#include "render/turn.h"

/// Sine and cosine of turns.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void turn_test(global const float* turns, global float* results, uint count) {
    const uint at = (uint)get_global_id(0) * LANES;
    if (at >= count) return;
    real values[2];
    sincos_turn(LOAD_LANES(turns + at), &values[0], &values[1]);
    store_components(values, results, count, at, 2);
}

/// The angles of points (x, y).
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void angle_test(global const float* points, global float* results, uint count) {
    const uint at = (uint)get_global_id(0) * LANES;
    if (at >= count) return;
    const real angle = atan2_pi(LOAD_LANES(points + count + at), LOAD_LANES(points + at));
    store_components(&angle, results, count, at, 1);
}
