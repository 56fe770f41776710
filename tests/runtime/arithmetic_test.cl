// SPDX-License-Identifier: MIT
// compile:
#include "runtime/numerics.h"

/// results = a / b, sqrt(a), a + b, a b, fma(a, b, a), each of `count` numbers after the other.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void arithmetic_test(global const float* a, global const float* b, global float* results, uint count) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const size_t n = count;
    results[i] = a[i] / b[i];
    results[n + i] = sqrt(a[i]);
    results[2 * n + i] = a[i] + b[i];
    results[3 * n + i] = a[i] * b[i];
    results[4 * n + i] = fma(a[i], b[i], a[i]);
}
