// SPDX-License-Identifier: MIT
// Reduction, one level: every tile of TILE elements becomes one. The host repeats it until one element is left.
//
// GROUP_SIZE                                 work-items per group, 1 or more
// SCALAR, COMPONENTS, OP_SUM/OP_MIN/OP_MAX   as in primitives/operator.h
// compile: SCALAR=int COMPONENTS=1 OP_MIN
// compile: SCALAR=ulong COMPONENTS=1 OP_MAX
// compile: SCALAR=float COMPONENTS=4 OP_SUM
// compile: SCALAR=float COMPONENTS=6 OP_SUM
#ifndef GROUP_SIZE
#error "define GROUP_SIZE"
#endif
#include "primitives/operator.h"

/// @pre  `in` holds `count` elements and does not overlap `out`. Slices are `length` elements long, a multiple of
///       TILE, and `slices` of them cover `count`; an empty array has one slice.
/// @post out[b] is the fold of tile b, the last tile may be short, and an empty array gives the neutral element as
///       its one tile.
/// Work-items share nothing, so there is no barrier and no local memory. Tiles, and so results, do not depend on how
/// the tiles are dealt to work-items.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void reduce(global const SCALAR* in, global SCALAR* out, uint count, uint length, uint slices) {
    const uint slice = (uint)get_global_id(0);
    if (slice >= slices) return;
    uint first = slice * length;
    const uint last = first + min(length, count - first);
    do {
        const uint end = first + min(TILE, last - first);
        STORE_ELEMENT(fold(in, first, end), out, first / TILE);
        first = end;
    } while (first < last);
}
