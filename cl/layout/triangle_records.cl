// SPDX-License-Identifier: MIT
// The leaves of the binary layouts.
//
// NAMED  1: leaves name triangles by a table; 0: by their index within the tree
// compile: NAMED=0
// compile: NAMED=1
#include "runtime/numerics.h"
#include "bounds/collinear.h"
#include "primitives/segments.h"
#include "shared/triangle.h"

#ifndef NAMED
#error "define NAMED"
#endif

/// records[i] = the triangle at sorted position i, its primitive counted from the start of its mesh or by names[], for
/// the positions of one slice.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void triangle_records(global const uint* order, global const uint* offsets, global const uint* names,
                      global const float* positions, global const uint* triangles, global Triangle* records, uint trees,
                      uint count, uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    if (begin >= count) return;
    const uint end = min(begin + slice, count);
    uint tree = segment_of(offsets, trees, begin);
    for (uint i = begin; i < end; ++i) {
        while (i >= offsets[tree + 1]) ++tree;
        const uint primitive = order[i];
        global const uint* corner = triangles + 3 * (size_t)primitive;
        float3 v0 = vload3(corner[0], positions), v1 = vload3(corner[1], positions), v2 = vload3(corner[2], positions);
        mark_collinear(&v0, &v1, &v2);
        Triangle record;
        vstore3(v0, 0, record.v0);
        vstore3(v1, 0, record.v1);
        vstore3(v2, 0, record.v2);
        record.primitive = NAMED ? names[primitive] : primitive - offsets[tree];
        record.reserved1 = record.reserved2 = 0;
        records[i] = record;
    }
}
