// SPDX-License-Identifier: MIT
// The plainest kernel that moves memory, in slices: what the bandwidth of the other kernels is held against.
//
// GROUP_SIZE   work-items per group, 1 or more
// compile: GROUP_SIZE=1
#ifndef GROUP_SIZE
#error "define GROUP_SIZE"
#endif

/// @pre  `in` and `out` hold `count` elements, a multiple of 16, as is `length`; `slices` slices of `length` cover
///       them.
/// @post `out` is `in`.
/// Every element has one writer: no barrier.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void copy(global const uint* restrict in, global uint* restrict out, uint count, uint length, uint slices) {
    const uint slice = (uint)get_global_id(0);
    if (slice >= slices) return;
    const uint first = slice * length;
    const uint last = first + min(length, count - first);
    for (uint i = first; i < last; i += 16) vstore16(vload16(0, in + i), 0, out + i);
}
