// SPDX-License-Identifier: MIT
// Random numbers by counter: a hash of (seed, index, draw), the same on every device and in any order.
#ifndef BOXWOOD_RENDER_RANDOM_H
#define BOXWOOD_RENDER_RANDOM_H
#include "runtime/real.h"

/// A bijection of 64 bits in which every input bit reaches every output bit: shifts by half the word and odd factors
/// with the constants of Stafford's variant 13 of the MurmurHash3 finaliser, as in splitmix64 (Steele et al. 2014).
INLINE wide mix_bits(wide z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9UL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebUL;
    return z ^ (z >> 31);
}

/// Key of the element `index` of a stream. Multiples of the golden ratio's odd 64-bit fraction are far apart.
INLINE wide random_key(ulong seed, wide index) {
    return mix_bits(mix_bits((wide)(seed + 0x9e3779b97f4a7c15UL)) + (index + 1) * 0x9e3779b97f4a7c15UL);
}

/// The draw-th 64 random bits of an element.
INLINE wide random_bits(wide key, whole draw) { return mix_bits(key + TO_WIDE(draw + 1) * 0x9e3779b97f4a7c15UL); }

#endif
