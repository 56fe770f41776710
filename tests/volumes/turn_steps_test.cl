// SPDX-License-Identifier: MIT
// compile:
#include "volumes/turn_steps.h"

/// steps = the four vectors, one after the other.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void turn_steps_test(global float* steps) {
    if (get_global_id(0) != 0) return;
    vstore8(COARSE_COSINES, 0, steps);
    vstore8(COARSE_SINES, 1, steps);
    vstore8(FINE_COSINES, 2, steps);
    vstore8(FINE_SINES, 3, steps);
}
