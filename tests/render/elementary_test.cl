// SPDX-License-Identifier: MIT
// compile:
#include "render/elementary.h"

/// logarithms[i] and fractions[i] of numbers[i].
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void elementary_test(global const float* numbers, global float* logarithms, global float* fractions, uint count) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    logarithms[i] = log2_of(numbers[i]);
    fractions[i] = absorbed_fraction(numbers[i]);
}
