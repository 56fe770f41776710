// SPDX-License-Identifier: MIT
// Queues of rays between the stages: adds the light of shadow rays, and compacts the queue after some rays have ended.
//
// GROUP_SIZE  work-items per work-group.
// RECORD      what goes with a ray: PathState or ShadowLight
// compile: RECORD=PathState
// compile: RECORD=ShadowLight
#include "render/path_sum.h"
#include "shared/ray.h"

#if !defined(GROUP_SIZE) || !defined(RECORD)
#error "define GROUP_SIZE and RECORD"
#endif

/// Adds the light of each shadow ray that met nothing (blocked[i] is 0) to its pixel; a pixel has at most one. A
/// work-item treats `length` consecutive ones of the `count`. No barrier: work-items share nothing.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void add_unblocked(global const uint* blocked, global const ShadowLight* lights, uint count, uint length,
                   global float* direct, global float* indirect) {
    const ulong begin = (ulong)get_global_id(0) * length;
    const ulong end = min(begin + length, (ulong)count);
    for (ulong i = begin; i < end; ++i) {
        if (blocked[i] == 0 && lights[i].pixel != BOXWOOD_NONE) add_shadow_light(lights + i, direct, indirect);
    }
}

/// The rays and records at the front of each slice of `length`, kept[slice] of them, go to places before[slice] on.
/// Input and output do not overlap. No barrier: work-items share nothing.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void move_kept(global const Ray* restrict rays, global const RECORD* restrict records, global const uint* before,
               global const uint* kept, uint length, uint slices, global Ray* restrict out_rays,
               global RECORD* restrict out_records) {
    const uint slice = (uint)get_global_id(0);
    if (slice >= slices) return;
    const size_t from = (size_t)slice * length, to = before[slice];
    const uint count = kept[slice];
    for (size_t i = 0; i < count; ++i) {
        vstore8(vload8(from + i, (global const uint*)rays), to + i, (global uint*)out_rays);
        if (sizeof(RECORD) == 32)
            vstore8(vload8(from + i, (global const uint*)records), to + i, (global uint*)out_records);
        else
            vstore4(vload4(from + i, (global const uint*)records), to + i, (global uint*)out_records);
    }
}
