// SPDX-License-Identifier: MIT
// Scan of every tile of TILE elements, started from the fold of all elements before the tile (computed by reduce.cl and
// by this kernel one level up).
//
// Sums of floats that are not negative never fall. Rounding is monotonic, so within a tile it is enough that every sum
// is an earlier one, plus a sum that never falls either. What is before the next tile is added up in another order: no
// sum of a tile without negative elements goes above it.
//
// GROUP_SIZE                                 work-items per group, 1 or more
// SCALAR, COMPONENTS, OP_SUM/OP_MIN/OP_MAX   as in primitives/operator.h, COMPONENTS 1 or 4
// INCLUSIVE                                  1: element i of the result covers in[0..i]; 0: in[0..i-1]
// compile: SCALAR=uint COMPONENTS=1 OP_SUM INCLUSIVE=0
// compile: SCALAR=ulong COMPONENTS=1 OP_MAX INCLUSIVE=1
// compile: SCALAR=float COMPONENTS=4 OP_MIN INCLUSIVE=0
// compile: SCALAR=float COMPONENTS=1 OP_SUM INCLUSIVE=1
// compile: SCALAR=float COMPONENTS=4 OP_SUM INCLUSIVE=0
#ifndef GROUP_SIZE
#error "define GROUP_SIZE"
#endif
#ifndef INCLUSIVE
#error "define INCLUSIVE (0 or 1)"
#endif
#include "primitives/operator.h"

#if COMPONENTS == 1

// The last sum of each lower half, for the lanes of the upper one; neutral elements for the lower.
static inline Scalar16 halves1(Scalar16 v) {
    return (Scalar16)(NEUTRAL, v.s0, NEUTRAL, v.s2, NEUTRAL, v.s4, NEUTRAL, v.s6, NEUTRAL, v.s8, NEUTRAL, v.sa, NEUTRAL,
                      v.sc, NEUTRAL, v.se);
}
static inline Scalar16 halves2(Scalar16 v) {
    const JOIN(SCALAR, 2) none = NEUTRAL;
    return (Scalar16)(none, v.s11, none, v.s55, none, v.s99, none, v.sdd);
}
static inline Scalar16 halves4(Scalar16 v) {
    const JOIN(SCALAR, 4) none = NEUTRAL;
    return (Scalar16)(none, v.s3333, none, v.sbbbb);
}
static inline Scalar16 halves8(Scalar16 v) { return (Scalar16)((JOIN(SCALAR, 8))NEUTRAL, v.s77777777); }

/// The vector moved up by one lane, a neutral element moved in.
static inline Scalar16 up1(Scalar16 v) { return (Scalar16)(NEUTRAL, v.s01234567, v.s89ab, v.scd, v.se); }

/// Elements per step.
#define STEP 16u

/// Scans 16 elements after `carry` and takes them into `carry`. By halves (Sklansky 1960), not by the shifts of Kogge
/// and Stone, which add up each lane's sum in an order of its own, so that floats may fall.
static inline Scalar16 scan_step(Scalar16 v, Element* carry) {
    v = combine16(halves1(v), v);
    v = combine16(halves2(v), v);
    v = combine16(halves4(v), v);
    v = combine16(halves8(v), v);
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

#define ROUNDS_int 0
#define ROUNDS_uint 0
#define ROUNDS_ulong 0
#define ROUNDS_float 1

#if defined(OP_SUM) && JOIN(ROUNDS_, SCALAR)

static inline int16 below_zero(Scalar16 v) { return v < 0.0f; }

/// Lowers the sums of a whole tile, which begins at element `first` of `out`, to `next`, what is before the next tile,
/// in the components that have no lane in `negative`. They do not fall, so those to be lowered are the last ones.
static inline void limit_sums(global SCALAR* out, Element next, int16 negative, uint first) {
#if COMPONENTS == 1
    if (any(negative)) return;
    const Scalar16 limit = next;
#else
    const int8 half_negative = negative.lo | negative.hi;
    const Element limits = select(next, (Element)INFINITY, half_negative.lo | half_negative.hi);
    const Scalar16 limit = (Scalar16)(limits, limits, limits, limits);
#endif
    global SCALAR* tile = out + (size_t)first * COMPONENTS;
    for (uint k = TILE * COMPONENTS / 16; k-- > 0;) {
        const Scalar16 sums = vload16(k, tile);
        if (!any(sums > limit)) return;
        vstore16(SMALLER(sums, limit), k, tile);
    }
}

#else

static inline int16 below_zero(Scalar16 v) { return 0; }
static inline void limit_sums(global SCALAR* out, Element next, int16 negative, uint first) {}

#endif

/// Fewer than STEP elements, from `first` to the end of the array: the same step, on a copy filled up with neutral
/// elements. No tile follows.
static inline void scan_rest(global const SCALAR* in, global SCALAR* out, uint first, uint count, Element carry) {
    SCALAR lanes[16];
    const uint scalars = (count - first) * COMPONENTS;
    const size_t base = (size_t)first * COMPONENTS;
    for (uint k = 0; k < 16; ++k) lanes[k] = k < scalars ? in[base + k] : NEUTRAL;
    vstore16(scan_step(vload16(0, lanes), &carry), 0, lanes);
    for (uint k = 0; k < scalars; ++k) out[base + k] = lanes[k];
}

/// @pre  `in` and `out` hold `count` > 0 elements and are the same buffer or do not overlap. before[b] is the fold of
///       all tiles before b, and sums of floats there do not fall unless a tile's sum is negative; it is not read for
///       tile 0. Slices as in reduce.cl.
/// @post `out` is the scan of `in`.
/// A work-item reads each element before it writes it and shares none with others: no barrier, and in place is safe.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void scan(global const SCALAR* in, global SCALAR* out, global const SCALAR* before, uint count, uint length,
          uint slices) {
    const uint slice = (uint)get_global_id(0);
    if (slice >= slices) return;
    uint first = slice * length;
    const uint last = first + min(length, count - first);
    while (first < last) {
        Element carry = first == 0 ? neutral() : LOAD_ELEMENT(before, first / TILE);
        const uint tile = first, end = first + min(TILE, last - first);
        int16 negative = 0;
        for (; end - first >= STEP; first += STEP) {
            const size_t base = (size_t)first * COMPONENTS;
            const Scalar16 v = vload16(0, in + base);
            negative |= below_zero(v);
            vstore16(scan_step(v, &carry), 0, out + base);
        }
        if (first < end) scan_rest(in, out, first, end, carry);
        if (end < count) limit_sums(out, LOAD_ELEMENT(before, end / TILE), negative, tile);
        first = end;
    }
}
