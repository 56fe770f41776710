// SPDX-License-Identifier: MIT
// Groups the inner nodes of all trees by height, so that the nodes of a level can be processed at once.
// compile:
#include "shared/types.h"

/// nodes[i] = i for one slice
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void number(global uint* nodes, uint count, uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    const uint end = begin < count ? min(begin + slice, count) : begin;
    for (uint i = begin; i < end; ++i) nodes[i] = i;
}

/// starts[h] = where the nodes of height h begin among nodes sorted by height. Before: heights ascend, each from 1 to
/// the greatest occurs; unused slots have 0 and starts[0] is not written.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void level_starts(global const uint* heights, global uint* starts, uint count, uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    const uint end = begin < count ? min(begin + slice, count) : begin;
    for (uint i = begin; i < end; ++i)
        if (heights[i] != 0 && (i == 0 || heights[i - 1] != heights[i])) starts[heights[i]] = i;
}
