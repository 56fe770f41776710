// SPDX-License-Identifier: MIT
// Oriented boxes of all nodes.
// compile:
#include "runtime/numerics.h"
#include "shared/aabb.h"
#include "shared/obb.h"

/// boxes[i] = the AABB of node i as an oriented box.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void aligned_boxes(global const Aabb* aabbs, global Obb* boxes, uint count) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    Obb box;
    for (int k = 0; k < 9; ++k) box.axes[k] = k % 4 == 0 ? 1.0f : 0.0f;
    for (int k = 0; k < 3; ++k) {
        const float low = aabbs[i].min[k], high = aabbs[i].max[k];
        box.center[k] = low <= high ? 0.5f * low + 0.5f * high : 0.0f;
        box.half[k] = low <= high ? max(high - box.center[k], box.center[k] - low) * (1.0f + 0x1p-22f) : -INFINITY;
    }
    box.aligned = 1;
    boxes[i] = box;
}
