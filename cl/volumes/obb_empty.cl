// SPDX-License-Identifier: MIT
// compile:
#include "shared/obb.h"

/// The unused slot at the end of each tree gets the empty box.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void empty_boxes(global const uint* offsets, global Obb* boxes, uint trees) {
    const uint tree = (uint)get_global_id(0);
    if (tree >= trees) return;
    Obb empty;
    for (int k = 0; k < 3; ++k) {
        empty.center[k] = 0.0f;
        empty.extent[k] = -INFINITY;
    }
    for (int k = 0; k < 9; ++k) empty.axes[k] = k % 4 == 0 ? 1.0f : 0.0f;
    empty.aligned = 1;
    boxes[offsets[tree + 1] - 1] = empty;
}
