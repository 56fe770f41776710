// SPDX-License-Identifier: MIT
// Scatter: out[indices[i]] = in[i]. Elements are moved as bits: a float and a uint share one program.
//
// GROUP_SIZE           work-items per group, 1 or more
// SCALAR, COMPONENTS   as in primitives/element.h
// compile: SCALAR=uint COMPONENTS=2
// compile: SCALAR=uint COMPONENTS=4
#ifndef GROUP_SIZE
#error "define GROUP_SIZE"
#endif
#include "primitives/element.h"

/// @pre  `indices` and `in` hold `count` elements, every index is inside `out` and occurs once.
///       No two buffers overlap. `slices` slices of `length` elements cover `count`.
/// @post out[indices[i]] = in[i] for every i < count.
///       Elements of `out` that no index names keep their value. Indices are distinct, so every element has at most one
///       writer: no barrier.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void scatter(global const SCALAR* restrict in, global const uint* restrict indices, global SCALAR* restrict out,
             uint count, uint length, uint slices) {
    const uint slice = (uint)get_global_id(0);
    if (slice >= slices) return;
    const uint first = slice * length;
    const uint last = first + min(length, count - first);
    for (uint i = first; i < last; ++i) STORE_ELEMENT(LOAD_ELEMENT(in, i), out, indices[i]);
}
