// SPDX-License-Identifier: MIT
// Every mask of eight and of four lanes through both twins.
//
// compile: PORTABLE_LANES=0
// compile: PORTABLE_LANES=1
#include "runtime/lanes.h"

/// out[4 * m + k] for the mask m in [0, 256): lanes8, lanes8_portable, lanes4, lanes4_portable (of the low bits).
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void lanes_test(global uint* out) {
    const uint m = (uint)get_global_id(0);
    if (m >= 256) return;
    const int8 bits = (int8)(1, 2, 4, 8, 16, 32, 64, 128);
    const int8 mask = (((int8)((int)m)) & bits) != 0;
    out[4 * m + 0] = lanes8(mask);
    out[4 * m + 1] = lanes8_portable(mask);
    out[4 * m + 2] = lanes4(mask.lo);
    out[4 * m + 3] = lanes4_portable(mask.lo);
}
