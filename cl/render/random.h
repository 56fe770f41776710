// SPDX-License-Identifier: MIT
// Random numbers by counter: a hash of (seed, index, draw), the same on every device and in any order.
#ifndef BOXWOOD_RENDER_RANDOM_H
#define BOXWOOD_RENDER_RANDOM_H
#include "runtime/inline.h"

/// A bijection of 64 bits in which every input bit reaches every output bit: shifts by half the word and odd factors
/// with the constants of Stafford's variant 13 of the MurmurHash3 finaliser, as in splitmix64 (Steele et al. 2014).
INLINE ulong mix_bits(ulong z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9UL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebUL;
    return z ^ (z >> 31);
}

/// Key of the element `index` of a stream. Multiples of the golden ratio's odd 64-bit fraction are far apart.
INLINE ulong random_key(ulong seed, ulong index) {
    return mix_bits(mix_bits(seed + 0x9e3779b97f4a7c15UL) + (index + 1) * 0x9e3779b97f4a7c15UL);
}

/// The draw-th 64 random bits of an element.
INLINE ulong random_bits(ulong key, uint draw) { return mix_bits(key + (draw + 1) * 0x9e3779b97f4a7c15UL); }

/// Uniform in (-1, 1), from the top 24 bits: the centres of 2^24 equal parts, exact in float up to the last bit.
INLINE float random_signed(ulong bits) { return (float)((int)(bits >> 40) - 0x800000) * 0x1p-23f + 0x1p-24f; }

/// A point uniform in the open unit disk, by rejection from the square: no trigonometric function, whose last digits
/// differ between devices. A square's point is rejected with probability 1 - pi/4, so that 32 draws fail once in 2^71.
INLINE float2 random_disk(ulong key) {
    for (uint draw = 0; draw < 32; ++draw) {
        const ulong bits = random_bits(key, draw);
        const float2 p = (float2)(random_signed(bits), random_signed(bits << 24));
        if (p.x * p.x + p.y * p.y < 1.0f) return p;
    }
    return (float2)(0.0f, 0.0f);
}

#endif
