// SPDX-License-Identifier: MIT
// Surface area and volume of every node, for the metrics of a tree.
// compile:
#include "runtime/numerics.h"
#include "shared/aabb.h"

/// areas[i], box_volumes[i] of node first + i in units of `unit`, a power of two near the size of the scene, so that neither
/// overflows or vanishes; 0 for empty boxes (unused slots), which would otherwise poison every sum.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void node_measures(global const Aabb* volumes, global float* areas, global float* box_volumes, float unit,
                    uint first, uint count) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const Aabb box = volumes[first + i];
    float area = 0.0f, volume = 0.0f;
    if (box.min[0] <= box.max[0]) {
        const float x = (box.max[0] - box.min[0]) / unit;
        const float y = (box.max[1] - box.min[1]) / unit;
        const float z = (box.max[2] - box.min[2]) / unit;
        area = 2.0f * (x * y + y * z + z * x);
        volume = x * y * z;
    }
    areas[i] = area;
    box_volumes[i] = volume;
}
