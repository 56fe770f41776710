// SPDX-License-Identifier: MIT
// The areas that hold each point and the one that a ray searches first, as traversal finds them.
// compile:
#include "runtime/inline.h"
#include "runtime/numerics.h"
#include "traverse/area_lookup.h"

/// found[i] = bit k for area k of up to 32 that holds the point i; steps[i] = areas that were tried.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void area_lookup_test(global const LocalArea* areas, global const AreaNode* nodes, global const uint* items,
                      global const float* points, global uint* found, global uint* tried, uint count) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const Areas a = {areas, nodes, items};
    const float3 p = vload3(i, points);
    global const AreaNode* leaf = &nodes[area_leaf(&a, p)];
    uint bits = 0;
    for (uint k = 0; k < leaf->count; ++k) {
        const uint area = items[leaf->first + k];
        if (is_in_area(&areas[area], p)) bits |= 1u << area;
    }
    found[i] = bits;
    tried[i] = leaf->count;
}

/// found[i] = the area to search first for ray i; exits[i] = how far it is in it.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void find_area_test(global const LocalArea* areas, global const AreaNode* nodes, global const uint* items,
                    global const float* origins, global const float* directions, global const float* starts,
                    global uint* found, global float* exits, uint count) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const Areas a = {areas, nodes, items};
    float exit;
    found[i] = find_area(&a, vload3(i, origins), vload3(i, directions), starts[i], &exit);
    exits[i] = exit;
}
