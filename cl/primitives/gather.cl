// SPDX-License-Identifier: MIT
// Gather: out[i] = in[indices[i]]. Elements are moved as bits: a float and a uint share one program.
//
// GROUP_SIZE           work-items per group, 1 or more
// SCALAR, COMPONENTS   as in primitives/element.h
// compile: SCALAR=uint COMPONENTS=1
// compile: SCALAR=uint COMPONENTS=6
#ifndef GROUP_SIZE
#error "define GROUP_SIZE"
#endif
#include "primitives/element.h"

/// @pre  `indices` and `out` hold `count` elements, every index is inside `in`.
///       No two buffers overlap. `slices` slices of `length` elements cover `count`.
/// @post out[i] = in[indices[i]] for every i < count.
///       The last slice may be short. Every element of `out` has one writer: no barrier.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void gather(global const SCALAR* restrict in, global const uint* restrict indices, global SCALAR* restrict out,
            uint count, uint length, uint slices) {
    const uint slice = (uint)get_global_id(0);
    if (slice >= slices) return;
    const uint first = slice * length;
    const uint last = first + min(length, count - first);
    for (uint i = first; i < last; ++i) STORE_ELEMENT(LOAD_ELEMENT(in, indices[i]), out, i);
}
