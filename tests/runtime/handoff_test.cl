// SPDX-License-Identifier: MIT
// Pairs of work-items far apart in the launch meet at one place; the second must see what the first wrote.
//
// compile:
#include "runtime/handoff.h"

/// Work-item i < 2 pairs writes left[i] and goes on to place i % pairs. Before: places 0. After: sums[p] = what both
/// wrote, seconds[p] = how many took over.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void handoff_test(global uint* left, global handoff_t* places, global uint* sums, global uint* seconds, uint pairs) {
    const uint i = (uint)get_global_id(0);
    if (i >= 2 * pairs) return;
    const uint place = i % pairs;
    left[i] = 3 * i + 1;
    if (!handoff_is_second(places + place)) return;
    sums[place] = left[place] + left[place + pairs];
    atomic_inc((volatile global uint*)(seconds + place));
}
