// SPDX-License-Identifier: MIT
// Scan of every block of BLOCK elements, started from what comes before the block (which reduce.cl and this kernel, one
// level up, have computed).
//
// GROUP_SIZE                                 work-items per group, 1 or more
// SCALAR, COMPONENTS, OP_SUM/OP_MIN/OP_MAX   as in primitives/operator.h, COMPONENTS 1 or 4
// INCLUSIVE                                  1: element i of the result covers in[0..i]; 0: in[0..i-1]
// compile: SCALAR=uint COMPONENTS=1 OP_SUM INCLUSIVE=0
// compile: SCALAR=ulong COMPONENTS=1 OP_MAX INCLUSIVE=1
// compile: SCALAR=float COMPONENTS=4 OP_MIN INCLUSIVE=0
#ifndef GROUP_SIZE
#error "define GROUP_SIZE"
#endif
#ifndef INCLUSIVE
#error "define INCLUSIVE (0 or 1)"
#endif
#include "primitives/operator.h"

#if COMPONENTS == 1

// The vector moved up by 1, 2, 4 or 8 lanes, neutral elements moved in.
static inline Scalar16 up1(Scalar16 v) {
    return (Scalar16)(NEUTRAL, v.s01234567, v.s89ab, v.scd, v.se);
}
static inline Scalar16 up2(Scalar16 v) { return (Scalar16)(NEUTRAL, NEUTRAL, v.s01234567, v.s89ab, v.scd); }
static inline Scalar16 up4(Scalar16 v) { return (Scalar16)((JOIN(SCALAR, 4))NEUTRAL, v.s01234567, v.s89ab); }
static inline Scalar16 up8(Scalar16 v) { return (Scalar16)((JOIN(SCALAR, 8))NEUTRAL, v.s01234567); }

/// Elements per step.
#define STEP 16u

/// Scans 16 elements after `carry` and takes them into `carry`.
static inline Scalar16 scan_step(Scalar16 v, Element* carry) {
    v = combine16(up1(v), v);
    v = combine16(up2(v), v);
    v = combine16(up4(v), v);
    v = combine16(up8(v), v);
    const Scalar16 before = *carry;
    *carry = combine(*carry, v.sf);
    return combine16(before, INCLUSIVE ? v : up1(v));
}

#else

#define STEP 4u

static inline Scalar16 scan_step(Scalar16 v, Element* carry) {
    const Element a = *carry, b = combine(a, v.s0123), c = combine(b, v.s4567), d = combine(c, v.s89ab);
    *carry = combine(d, v.scdef);
    return INCLUSIVE ? (Scalar16)(b, c, d, *carry) : (Scalar16)(a, b, c, d);
}

#endif

/// Fewer than STEP elements, from `first` to the end of the array: the same step, on a copy filled up with neutral
/// elements.
static inline void scan_rest(global const SCALAR* in, global SCALAR* out, uint first, uint count, Element carry) {
    SCALAR lanes[16];
    const uint scalars = (count - first) * COMPONENTS;
    const size_t base = (size_t)first * COMPONENTS;
    for (uint k = 0; k < 16; ++k) lanes[k] = k < scalars ? in[base + k] : NEUTRAL;
    vstore16(scan_step(vload16(0, lanes), &carry), 0, lanes);
    for (uint k = 0; k < scalars; ++k) out[base + k] = lanes[k];
}

/// @pre  `in` and `out` hold `count` > 0 elements and are the same buffer or do not overlap. before[b] is the fold of
///       all blocks before b; it is not read for block 0. Slices as in reduce.cl.
/// @post `out` is the scan of `in`.
/// A work-item reads each element before it writes it and shares none with others: no barrier, and in place is safe.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) void scan(global const SCALAR* in, global SCALAR* out,
                                                                         global const SCALAR* before, uint count,
                                                                         uint length, uint slices) {
    const uint slice = (uint)get_global_id(0);
    if (slice >= slices) return;
    uint first = slice * length;
    const uint last = first + min(length, count - first);
    while (first < last) {
        Element carry = first == 0 ? neutral() : LOAD_ELEMENT(before, first / BLOCK);
        const uint end = first + min(BLOCK, last - first);
        for (; end - first >= STEP; first += STEP) {
            const size_t base = (size_t)first * COMPONENTS;
            vstore16(scan_step(vload16(0, in + base), &carry), 0, out + base);
        }
        if (first < end) scan_rest(in, out, first, end, carry);
        first = end;
    }
}
