// SPDX-License-Identifier: MIT
// The oriented box of each tree.
// compile:
#include "shared/obb.h"

/// roots[t] = the box of the root of tree t, which is an inner node or, over one primitive, a leaf.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void root_boxes(global const uint* offsets, global const Obb* boxes, global Obb* roots, uint trees, uint count) {
    const uint t = (uint)get_global_id(0);
    if (t >= trees) return;
    const uint first = offsets[t];
    roots[t] = boxes[offsets[t + 1] - first == 1 ? count + first : first];
}
