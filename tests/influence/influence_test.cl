// SPDX-License-Identifier: MIT
// The functions of influence/influence.h, one call a work-item.
// compile: GROUP_SIZE=1
#include "influence/influence.h"

/// flags[i]: bit 0 where areas[i] contains the origin of ray i, bit 1 where the ray is affine to it; exits[i]: how far
/// it is inside.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void influence_test(global const InfluenceRecord* areas, global const float* origins, global const float* directions,
                    global float* exits, global uint* flags, uint count) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const float3 origin = vload3(i, origins), direction = vload3(i, directions);
    flags[i] =
        (area_contains(areas + i, origin) ? 1u : 0u) | (is_direction_affine(areas + i, origin, direction) ? 2u : 0u);
    exits[i] = area_exit(areas + i, origin, direction);
}
