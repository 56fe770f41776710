// SPDX-License-Identifier: MIT
// Stream compaction: count the kept elements of each slice, scan the counts (scan.cl), move the elements. Elements are
// moved as bits: a float and a uint share one program.
//
// GROUP_SIZE           work-items per group, 1 or more
// SCALAR, COMPONENTS   as in primitives/element.h
// compile: SCALAR=uint COMPONENTS=1
// compile: SCALAR=uint COMPONENTS=6
#ifndef GROUP_SIZE
#error "define GROUP_SIZE"
#endif
#include "primitives/element.h"

/// @pre  `flags` holds `count` > 0 entries; `slices` slices of `length` cover them.
/// @post kept[slice] is the number of flags in the slice that are not 0.
/// Each entry has one writer: no barrier.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void compact_count(global const uint* flags, global uint* kept, uint count, uint length, uint slices) {
    const uint slice = (uint)get_global_id(0);
    if (slice >= slices) return;
    uint i = slice * length;
    const uint last = i + min(length, count - i);
    int16 lanes = 0; // each lane that is kept adds -1
    for (; last - i >= 16; i += 16) lanes += vload16(0, flags + i) != 0u;
    const int8 eighth = lanes.lo + lanes.hi;
    const int4 quarter = eighth.lo + eighth.hi;
    uint sum = (uint) - (quarter.x + quarter.y + quarter.z + quarter.w);
    for (; i < last; ++i) sum += flags[i] != 0u;
    kept[slice] = sum;
}

/// @pre  before[slice] is the number of elements kept in earlier slices, kept[slice] that in the slice. No two buffers
///       overlap.
/// @post out[0 .. total - 1] are the kept elements in order, total[0] is their number. The rest of `out` is untouched.
/// A slice writes out[before .. before + kept - 1] only. Inside that range it may write an element that is not kept,
/// which the next kept one of the same slice overwrites; once all are kept it stops. So there is no branch on the
/// flags, one writer per element, and no barrier.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void compact(global const SCALAR* restrict in, global const uint* restrict flags, global const uint* restrict before,
             global const uint* restrict kept, global SCALAR* restrict out, global uint* restrict total, uint length,
             uint slices) {
    const uint slice = (uint)get_global_id(0);
    if (slice >= slices) return;
    uint place = before[slice];
    const uint end = place + kept[slice];
    if (slice == slices - 1) total[0] = end;
    uint i = slice * length;
    // With 8 kept elements to come there are as many to read, and 8 in a row need one test of the end.
    for (; end - place >= 8; i += 8) {
        const int8 steps = vload8(0, flags + i) != 0u; // -1 where an element is kept
#define MOVE(k)                                         \
    STORE_ELEMENT(LOAD_ELEMENT(in, i + k), out, place); \
    place -= steps.s##k
        MOVE(0);
        MOVE(1);
        MOVE(2);
        MOVE(3);
        MOVE(4);
        MOVE(5);
        MOVE(6);
        MOVE(7);
#undef MOVE
    }
    for (; place < end; ++i) {
        STORE_ELEMENT(LOAD_ELEMENT(in, i), out, place);
        place += flags[i] != 0u;
    }
}
