// SPDX-License-Identifier: MIT
// Shows what primary rays hit, and their cost, as light. A work-item writes `length` consecutive pixels of the `count`.
// No barriers: work-items share nothing.
//
// GROUP_SIZE  work-items per work-group.
// compile:
#include "runtime/numerics.h"
#include "shared/ray.h"

#ifndef GROUP_SIZE
#error "define GROUP_SIZE"
#endif

/// The volumes and the triangles tested for each ray.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void cost_planes(global const RayStatistics* statistics, uint count, uint length, global uint* volumes,
                 global uint* primitives) {
    const ulong begin = (ulong)get_global_id(0) * length;
    const ulong end = min(begin + length, (ulong)count);
    for (ulong i = begin; i < end; ++i) {
        volumes[i] = statistics[i].volumes;
        primitives[i] = statistics[i].primitives;
    }
}

/// light[3 * i] and the two behind it = the volumes tested for ray i.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void cost_light(global const RayStatistics* statistics, uint count, uint length, global float* light) {
    const ulong begin = (ulong)get_global_id(0) * length;
    const ulong end = min(begin + length, (ulong)count);
    for (ulong i = begin; i < end; ++i) vstore3((float3)((float)statistics[i].volumes), i, light);
}

/// light[3 * i] and the two behind it, the normal at hits[i], become (1 + n) / 2, or 0 for a miss.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void normal_light(global const Hit* hits, uint count, uint length, global float* light) {
    const ulong begin = (ulong)get_global_id(0) * length;
    const ulong end = min(begin + length, (ulong)count);
    for (ulong i = begin; i < end; ++i) {
        const float3 color = clamp(0.5f + 0.5f * vload3(i, light), 0.0f, 1.0f);
        const float hit = hits[i].primitive == BOXWOOD_NONE ? 0.0f : 1.0f;
        vstore3(hit * color, i, light);
    }
}
