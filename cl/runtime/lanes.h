// SPDX-License-Identifier: MIT
// Which lanes of a comparison hold: the one place where vendor intrinsics are allowed, with the portable twin beside.
//
// PORTABLE_LANES  1: portable code only; 0: the device's own instruction where this file knows it.
#ifndef BOXWOOD_RUNTIME_LANES_H
#define BOXWOOD_RUNTIME_LANES_H

#ifndef PORTABLE_LANES
#error "define PORTABLE_LANES (0 or 1)"
#endif

/// Bit i is the sign bit of lane i; comparisons of vectors give -1 in the lanes that hold.
inline uint lanes8_portable(int8 mask) {
    const int8 bits = mask & (int8)(1, 2, 4, 8, 16, 32, 64, 128);
    const int4 half_sum = bits.lo | bits.hi;
    const int2 quarter = half_sum.lo | half_sum.hi;
    return (uint)(quarter.lo | quarter.hi);
}

inline uint lanes4_portable(int4 mask) {
    const int4 bits = mask & (int4)(1, 2, 4, 8);
    const int2 half_sum = bits.lo | bits.hi;
    return (uint)(half_sum.lo | half_sum.hi);
}

/// The lowest bit set in a mask that is not zero.
inline uint first_lane(uint mask) { return 31 - clz(mask & -mask); }

#if !PORTABLE_LANES && defined(__AVX__) && __has_builtin(__builtin_ia32_movmskps256)
inline uint lanes8(int8 mask) { return (uint)__builtin_ia32_movmskps256(as_float8(mask)); }
inline uint lanes4(int4 mask) { return (uint)__builtin_ia32_movmskps(as_float4(mask)); }
#else
inline uint lanes8(int8 mask) { return lanes8_portable(mask); }
inline uint lanes4(int4 mask) { return lanes4_portable(mask); }
#endif

#endif
