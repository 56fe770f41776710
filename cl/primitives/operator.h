// SPDX-License-Identifier: MIT
// The operators of reductions and scans, on elements and on vectors of 16 scalars, and the fold of a range in an order
// that depends on nothing but the range: that is what makes sums of floats the same on every device.
//
// SCALAR, COMPONENTS            as in primitives/element.h; six components need SCALAR=float and are boxes
// OP_SUM, OP_MIN or OP_MAX      one of them defined; for boxes OP_SUM, which is the hull
//
// Minimum and maximum keep the first operand unless the second is strictly beyond it. Inputs hold no NaN: with one, the
// result is unspecified. Of -0 and +0, which tie, either may come out.
#ifndef BOXWOOD_PRIMITIVES_OPERATOR_H
#define BOXWOOD_PRIMITIVES_OPERATOR_H

#include "runtime/numerics.h"
#include "primitives/element.h"

#if defined(OP_SUM) + defined(OP_MIN) + defined(OP_MAX) != 1
#error "define exactly one of OP_SUM, OP_MIN, OP_MAX"
#endif
#if COMPONENTS == 6 && !defined(OP_SUM)
#error "boxes have a hull (OP_SUM) only"
#endif

/// Elements that are folded in one go; also the unit that slices are cut in. A power of two, as on the host.
#define TILE 1024u

typedef JOIN(SCALAR, 16) Scalar16;

#define SMALLEST_int INT_MIN
#define SMALLEST_uint 0u
#define SMALLEST_ulong 0ul
#define SMALLEST_float (-INFINITY)
#define LARGEST_int INT_MAX
#define LARGEST_uint UINT_MAX
#define LARGEST_ulong ULONG_MAX
#define LARGEST_float INFINITY

// The choice between two vectors is the vector form of ?:, which picks by the sign of each comparison lane.
#define SMALLER(a, b) ((b) < (a) ? (b) : (a))
#define LARGER(a, b) ((b) > (a) ? (b) : (a))

#if COMPONENTS == 6

static inline Element neutral(void) {
    return (Element)(INFINITY, INFINITY, INFINITY, -INFINITY, -INFINITY, -INFINITY, 0.0f, 0.0f);
}

static inline Element combine(Element a, Element b) {
    const Element low = SMALLER(a, b), high = LARGER(a, b);
    return (Element)(low.s012, high.s3, high.hi);
}

// Eight boxes are three vectors of 16. With the sign of every maximum flipped, one minimum serves all lanes.
#define ROW 8u
#define FLIP ((int)0x80000000)
#define FLIP_0 ((int16)(0, 0, 0, FLIP, FLIP, FLIP, 0, 0, 0, FLIP, FLIP, FLIP, 0, 0, 0, FLIP))
#define FLIP_1 ((int16)(FLIP, FLIP, 0, 0, 0, FLIP, FLIP, FLIP, 0, 0, 0, FLIP, FLIP, FLIP, 0, 0))
#define FLIP_2 ((int16)(0, FLIP, FLIP, FLIP, 0, 0, 0, FLIP, FLIP, FLIP, 0, 0, 0, FLIP, FLIP, FLIP))

static inline float16 flip(float16 lanes, int16 mask) { return as_float16(as_int16(lanes) ^ mask); }

static inline Element element_of_lanes(const float* lanes) {
    return (Element)(vload4(0, lanes), vload2(0, lanes + 4), 0.0f, 0.0f);
}

/// The hull of the `rows` x ROW boxes at `in`, rows > 0: slot k of a row joins slot k of the next row, then the eight
/// slots are joined by halves.
static inline Element fold_rows(global const float* in, uint rows) {
    float16 a = INFINITY, b = INFINITY, c = INFINITY;
    for (uint row = 0; row < rows; ++row, in += 6 * ROW) {
        const float16 x = flip(vload16(0, in), FLIP_0), y = flip(vload16(1, in), FLIP_1);
        const float16 z = flip(vload16(2, in), FLIP_2);
        a = SMALLER(a, x);
        b = SMALLER(b, y);
        c = SMALLER(c, z);
    }
    float lanes[6 * ROW];
    vstore16(flip(a, FLIP_0), 0, lanes);
    vstore16(flip(b, FLIP_1), 1, lanes);
    vstore16(flip(c, FLIP_2), 2, lanes);
    Element slots[ROW / 2];
    for (uint k = 0; k < ROW / 2; ++k)
        slots[k] = combine(element_of_lanes(lanes + 6 * k), element_of_lanes(lanes + 6 * (k + ROW / 2)));
    return combine(combine(slots[0], slots[2]), combine(slots[1], slots[3]));
}

#else

#if defined(OP_SUM)
#define NEUTRAL ((SCALAR)0)
#define COMBINE(a, b) ((a) + (b))
#elif defined(OP_MIN)
#define NEUTRAL ((SCALAR)JOIN(LARGEST_, SCALAR))
#define COMBINE(a, b) SMALLER(a, b)
#else
#define NEUTRAL ((SCALAR)JOIN(SMALLEST_, SCALAR))
#define COMBINE(a, b) LARGER(a, b)
#endif

static inline Element neutral(void) { return (Element)NEUTRAL; }
static inline Element combine(Element a, Element b) { return COMBINE(a, b); }
static inline Scalar16 combine16(Scalar16 a, Scalar16 b) { return COMBINE(a, b); }

// Four vectors of 16: enough independent chains to hide the latency of an addition.
#define ROW (64u / COMPONENTS)

/// The fold of the `rows` x ROW elements at `in`, rows > 0: slot k of a row joins slot k of the next row, then the
/// slots are joined by halves.
static inline Element fold_rows(global const SCALAR* in, uint rows) {
    Scalar16 a = NEUTRAL, b = NEUTRAL, c = NEUTRAL, d = NEUTRAL;
    for (uint row = 0; row < rows; ++row, in += COMPONENTS * ROW) {
        a = combine16(a, vload16(0, in));
        b = combine16(b, vload16(1, in));
        c = combine16(c, vload16(2, in));
        d = combine16(d, vload16(3, in));
    }
    const Scalar16 lanes = combine16(combine16(a, c), combine16(b, d));
    const JOIN(SCALAR, 8) eighth = COMBINE(lanes.lo, lanes.hi);
    const JOIN(SCALAR, 4) quarter = COMBINE(eighth.lo, eighth.hi);
#if COMPONENTS == 4
    return quarter;
#else
    const JOIN(SCALAR, 2) half_fold = COMBINE(quarter.lo, quarter.hi);
    return COMBINE(half_fold.lo, half_fold.hi);
#endif
}

#endif

/// The fold of elements [first, last) of `in`; the neutral element when there are none. Whole rows first, then what is
/// left one by one: at most TILE / ROW + ROW elements enter one chain of additions for ranges of up to TILE.
static inline Element fold(global const SCALAR* in, uint first, uint last) {
    const uint rows = (last - first) / ROW;
    Element total = neutral();
    if (rows > 0) total = fold_rows(in + (size_t)first * COMPONENTS, rows);
    for (uint i = first + rows * ROW; i < last; ++i) total = combine(total, LOAD_ELEMENT(in, i));
    return total;
}

#endif
