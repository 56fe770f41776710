// SPDX-License-Identifier: MIT
// Which lanes of a comparison hold: the one place where vendor intrinsics are allowed, with the portable twin beside.
//
// PORTABLE_LANES  1: portable code only; 0: the device's own instruction where this file knows it.
#ifndef BOXWOOD_RUNTIME_LANES_H
#define BOXWOOD_RUNTIME_LANES_H
#include "runtime/inline.h"

#ifndef PORTABLE_LANES
#error "define PORTABLE_LANES (0 or 1)"
#endif

/// Bit i tells lane i of a mask of zeros and minus ones, as comparisons of vectors make them.
/// Portably: one byte per lane, all ones where it holds, keeps one bit each, and a product adds them up in its top
/// byte.
INLINE uint lanes8_portable(int8 mask) {
    const ulong bytes = as_ulong(convert_char8(mask));
    return (uint)((bytes & 0x8040201008040201ul) * 0x0101010101010101ul >> 56);
}

INLINE uint lanes4_portable(int4 mask) {
    const uint bytes = as_uint(convert_char4(mask));
    return (bytes & 0x08040201u) * 0x01010101u >> 24;
}

/// The lowest and the highest bit set in a mask that is not zero.
#if __OPENCL_C_VERSION__ >= 200
INLINE uint first_lane(uint mask) { return ctz(mask); }
#else
INLINE uint first_lane(uint mask) { return 31 - clz(mask & -mask); }
#endif

INLINE uint last_lane(uint mask) { return 31 - clz(mask); }

// Of the target, since front ends that make SPIR-V have the builtins of the processor that they run on.
#if !PORTABLE_LANES && defined(__x86_64__) && defined(__AVX__) && __has_builtin(__builtin_ia32_movmskps256)
INLINE uint lanes8(int8 mask) { return (uint)__builtin_ia32_movmskps256(as_float8(mask)); }
INLINE uint lanes4(int4 mask) { return (uint)__builtin_ia32_movmskps(as_float4(mask)); }
#else
INLINE uint lanes8(int8 mask) { return lanes8_portable(mask); }
INLINE uint lanes4(int4 mask) { return lanes4_portable(mask); }
#endif

#endif
