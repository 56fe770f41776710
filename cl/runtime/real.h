// SPDX-License-Identifier: MIT
// How many boxes or paths a work-item processes at once: the code of oriented boxes and of shading is written on
// `real`, which is one float, eight or sixteen. A device with few, large work-items takes several, to use its vector
// units; each lane does the same operations either way, so the results are the same.
//
// LANES  1, 8 or 16
#ifndef BOXWOOD_RUNTIME_REAL_H
#define BOXWOOD_RUNTIME_REAL_H
#include "runtime/inline.h"
#include "runtime/numerics.h"

#if LANES == 8 || LANES == 16
#define PASTE_NAMES(a, b) a##b
#define PASTE(a, b) PASTE_NAMES(a, b)
typedef PASTE(float, LANES) real;
typedef PASTE(int, LANES) mask; ///< As comparisons give it: every bit of a lane, or none.
typedef PASTE(uint, LANES) whole;
typedef PASTE(ulong, LANES) wide;
#define AS_INT(x) PASTE(as_int, LANES)(x)
#define AS_REAL(x) PASTE(as_float, LANES)(x)
#define AS_WHOLE(x) PASTE(as_uint, LANES)(x)
#define TO_REAL(x) PASTE(convert_float, LANES)(x)
#define TO_WHOLE(x) PASTE(convert_uint, LANES)(x)
#define TO_WIDE(x) PASTE(convert_ulong, LANES)(x)
#define ANY(m) any(m)
#define STORE_LANES(values, target) PASTE(vstore, LANES)(values, 0, target)
#define LOAD_LANES(source) PASTE(vload, LANES)(0, source)
#elif LANES == 1
typedef float real;
typedef int mask; ///< As comparisons give it: not zero where it holds.
typedef uint whole;
typedef ulong wide;
#define AS_INT(x) as_int(x)
#define AS_REAL(x) as_float(x)
#define AS_WHOLE(x) as_uint(x)
#define TO_REAL(x) ((float)(x))
#define TO_WHOLE(x) ((uint)(x))
#define TO_WIDE(x) ((ulong)(x))
#define ANY(m) ((m) != 0)
#define STORE_LANES(values, target) (*(target) = (values))
#define LOAD_LANES(source) (*(source))
#else
#error "define LANES (1, 8 or 16)"
#endif

// Records of floats are read and written whole, one row per lane, and transposed in registers: picking single floats
// for the lanes would make gather instructions of them, which are slow.

#if LANES > 1

#define PAIRS_LOW(p, q) ((float8)((p).s0, (q).s0, (p).s1, (q).s1, (p).s4, (q).s4, (p).s5, (q).s5))
#define PAIRS_HIGH(p, q) ((float8)((p).s2, (q).s2, (p).s3, (q).s3, (p).s6, (q).s6, (p).s7, (q).s7))
#define FOURS_LOW(p, q) ((float8)((p).s01, (q).s01, (p).s45, (q).s45))
#define FOURS_HIGH(p, q) ((float8)((p).s23, (q).s23, (p).s67, (q).s67))

/// Rows become columns.
INLINE void transpose(float8* r) {
    const float8 a0 = PAIRS_LOW(r[0], r[1]), a1 = PAIRS_HIGH(r[0], r[1]);
    const float8 a2 = PAIRS_LOW(r[2], r[3]), a3 = PAIRS_HIGH(r[2], r[3]);
    const float8 a4 = PAIRS_LOW(r[4], r[5]), a5 = PAIRS_HIGH(r[4], r[5]);
    const float8 a6 = PAIRS_LOW(r[6], r[7]), a7 = PAIRS_HIGH(r[6], r[7]);
    const float8 b0 = FOURS_LOW(a0, a2), b1 = FOURS_HIGH(a0, a2), b2 = FOURS_LOW(a1, a3), b3 = FOURS_HIGH(a1, a3);
    const float8 b4 = FOURS_LOW(a4, a6), b5 = FOURS_HIGH(a4, a6), b6 = FOURS_LOW(a5, a7), b7 = FOURS_HIGH(a5, a7);
    r[0] = (float8)(b0.lo, b4.lo);
    r[1] = (float8)(b1.lo, b5.lo);
    r[2] = (float8)(b2.lo, b6.lo);
    r[3] = (float8)(b3.lo, b7.lo);
    r[4] = (float8)(b0.hi, b4.hi);
    r[5] = (float8)(b1.hi, b5.hi);
    r[6] = (float8)(b2.hi, b6.hi);
    r[7] = (float8)(b3.hi, b7.hi);
}

#define ROW(lane) (base + stride * (size_t)index[lane])

// Eight rows, without a loop that would keep them in memory.
#define LOAD_EIGHT(r, LOAD, first) \
    do {                           \
        r[0] = LOAD((first));      \
        r[1] = LOAD((first) + 1);  \
        r[2] = LOAD((first) + 2);  \
        r[3] = LOAD((first) + 3);  \
        r[4] = LOAD((first) + 4);  \
        r[5] = LOAD((first) + 5);  \
        r[6] = LOAD((first) + 6);  \
        r[7] = LOAD((first) + 7);  \
        transpose(r);              \
    } while (0)
#define STORE_EIGHT(r, STORE, first) \
    do {                             \
        transpose(r);                \
        STORE(r[0], (first));        \
        STORE(r[1], (first) + 1);    \
        STORE(r[2], (first) + 2);    \
        STORE(r[3], (first) + 3);    \
        STORE(r[4], (first) + 4);    \
        STORE(r[5], (first) + 5);    \
        STORE(r[6], (first) + 6);    \
        STORE(r[7], (first) + 7);    \
    } while (0)
#if LANES == 8
#define LOAD_ROWS(LOAD) LOAD_EIGHT(v, LOAD, 0)
#define STORE_ROWS(STORE) STORE_EIGHT(v, STORE, 0)
#else
#define LOAD_ROWS(LOAD)                                                                  \
    do {                                                                                 \
        float8 low[8], high[8];                                                          \
        LOAD_EIGHT(low, LOAD, 0);                                                        \
        LOAD_EIGHT(high, LOAD, 8);                                                       \
        _Pragma("unroll") for (int k = 0; k < 8; ++k) v[k] = (float16)(low[k], high[k]); \
    } while (0)
#define STORE_ROWS(STORE)                               \
    do {                                                \
        float8 low[8], high[8];                         \
        _Pragma("unroll") for (int k = 0; k < 8; ++k) { \
            low[k] = v[k].lo;                           \
            high[k] = v[k].hi;                          \
        }                                               \
        STORE_EIGHT(low, STORE, 0);                     \
        STORE_EIGHT(high, STORE, 8);                    \
    } while (0)
#endif

/// v[k] = base[stride * index + k] of each lane's index, k < 8, and the same of six, four and three floats. v has room
/// for 8.
INLINE void load_rows8(global const float* base, uint stride, const uint* index, real* v) {
#define LOAD(lane) vload8(0, ROW(lane))
    LOAD_ROWS(LOAD);
#undef LOAD
}
INLINE void load_rows6(global const float* base, uint stride, const uint* index, real* v) {
#define LOAD(lane) (float8)(vload4(0, ROW(lane)), vload2(2, ROW(lane)), 0.0f, 0.0f)
    LOAD_ROWS(LOAD);
#undef LOAD
}
INLINE void load_rows4(global const float* base, uint stride, const uint* index, real* v) {
#define LOAD(lane) (float8)(vload4(0, ROW(lane)), (float4)(0.0f))
    LOAD_ROWS(LOAD);
#undef LOAD
}
INLINE void load_rows3(global const float* base, uint stride, const uint* index, real* v) {
#define LOAD(lane) (float8)(vload3(0, ROW(lane)), 0.0f, (float4)(0.0f))
    LOAD_ROWS(LOAD);
#undef LOAD
}

/// The reverse, lane after lane, for the first `count` lanes; v is used up.
INLINE void store_rows8(real* v, global float* base, uint stride, const uint* index, uint count) {
#define STORE(row, lane) \
    if ((lane) < count) vstore8(row, 0, ROW(lane))
    STORE_ROWS(STORE);
#undef STORE
}
INLINE void store_rows4(real* v, global float* base, uint stride, const uint* index, uint count) {
    v[4] = v[5] = v[6] = v[7] = 0.0f;
#define STORE(row, lane) \
    if ((lane) < count) vstore4((row).lo, 0, ROW(lane))
    STORE_ROWS(STORE);
#undef STORE
}
INLINE void store_rows3(real* v, global float* base, uint stride, const uint* index, uint count) {
    v[3] = v[4] = v[5] = v[6] = v[7] = 0.0f;
#define STORE(row, lane) \
    if ((lane) < count) vstore3((row).s012, 0, ROW(lane))
    STORE_ROWS(STORE);
#undef STORE
}

#else

INLINE void load_rows8(global const float* base, uint stride, const uint* index, real* v) {
    vstore8(vload8(0, base + stride * (size_t)index[0]), 0, v);
}
INLINE void load_rows6(global const float* base, uint stride, const uint* index, real* v) {
    global const float* row = base + stride * (size_t)index[0];
    vstore4(vload4(0, row), 0, v);
    vstore2(vload2(2, row), 2, v);
}
INLINE void load_rows4(global const float* base, uint stride, const uint* index, real* v) {
    vstore4(vload4(0, base + stride * (size_t)index[0]), 0, v);
}
INLINE void load_rows3(global const float* base, uint stride, const uint* index, real* v) {
    vstore3(vload3(0, base + stride * (size_t)index[0]), 0, v);
}
INLINE void store_rows8(real* v, global float* base, uint stride, const uint* index, uint count) {
    vstore8(vload8(0, v), 0, base + stride * (size_t)index[0]);
}
INLINE void store_rows3(real* v, global float* base, uint stride, const uint* index, uint count) {
    vstore3(vload3(0, v), 0, base + stride * (size_t)index[0]);
}
INLINE void store_rows4(real* v, global float* base, uint stride, const uint* index, uint count) {
    vstore4(vload4(0, v), 0, base + stride * (size_t)index[0]);
}

#endif

/// `yes` in the lanes where `condition`, a comparison, holds; else `no`.
#define CHOOSE(condition, yes, no) select((no), (yes), (condition))
#define CHOOSE_INT(condition, yes, no) select((mask)(no), (mask)(yes), (condition))
#if LANES > 1
// By select(): of == compilers make the exclusive or of a vector of bits, which Oclgrind 21.10 takes for true in every
// lane.
#define NOT(condition) select((mask)(-1), (mask)(0), (condition))
#else
#define NOT(condition) ((condition) == 0)
#endif

#endif
