// SPDX-License-Identifier: MIT
// Points for the integrals of a path: dimension by dimension and sample by sample, each in constant time from (seed,
// pixel, sample, dimension), so that any order and any device gives the same.
//
// SAMPLER  0 random: independent points. 1 stratified: one point in each cell of a grid over all samples of a pixel
//          (dissertation 3.7.4, after Pharr 2019), the cells in an order of their own for each pixel and dimension. 2
//          sobol: the first two dimensions of Sobol's sequence with hashed Owen scrambling and shuffling for each pixel
//          and dimension (Burley 2020).
#ifndef BOXWOOD_RENDER_SAMPLER_H
#define BOXWOOD_RENDER_SAMPLER_H
#include "render/random.h"

#if !defined(SAMPLER) || SAMPLER < 0 || SAMPLER > 2
#error "define SAMPLER (0 random, 1 stratified, 2 sobol)"
#endif

/// A sample of each lane's pixel.
typedef struct Sampler {
    wide key;    ///< Of the seed and the pixel.
    uint sample; ///< Index among the samples of the pixel.
    uint count;  ///< Samples that are planned for it, >= 1; SAMPLER 1 only.
} Sampler;

/// Uniform in [0, 1), from the top 24 bits.
INLINE real unit_real(whole bits) { return TO_REAL(AS_INT(bits >> 8)) * 0x1p-24f; }

/// The upper and the lower half of 64 random bits so.
INLINE void unit_reals(wide bits, real* u, real* v) {
    *u = unit_real(TO_WHOLE(bits >> 32));
    *v = unit_real(TO_WHOLE(bits));
}

INLINE whole reverse_bits(whole x) {
    x = rotate(x, (whole)(16u)); // by name: Oclgrind lacks the instruction that compilers make of the whole otherwise
    x = ((x & 0xff00ff00u) >> 8) | ((x & 0x00ff00ffu) << 8);
    x = ((x & 0xf0f0f0f0u) >> 4) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x & 0xccccccccu) >> 2) | ((x & 0x33333333u) << 2);
    return ((x & 0xaaaaaaaau) >> 1) | ((x & 0x55555555u) << 1);
}

/// A permutation of 32 bits in which a bit depends on itself and on lower ones alone: Owen's scrambling of digits that
/// are given last one first, by the hash of Laine and Karras 2011 with the constants of Vegdahl.
INLINE whole scramble_reversed(whole x, whole seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

/// A bijection of 32 bits in which every input bit reaches every output bit (Wellons' lowbias32).
INLINE whole mix_word(whole x) {
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}

/// Digits, last one first, of the second dimension of Sobol's sequence; those of the first are the index. Digit i is
/// the sum of the bits j of the index for which binomial(j, i) is odd, which is when j has every bit of i (Lucas): a
/// sum over supersets.
INLINE whole sobol_second(whole index) {
    index ^= (index >> 1) & 0x55555555u;
    index ^= (index >> 2) & 0x33333333u;
    index ^= (index >> 4) & 0x0f0f0f0fu;
    index ^= (index >> 8) & 0x00ff00ffu;
    return index ^ (index >> 16);
}

/// The place of `index` in a permutation of [0, count) chosen by `seed` (Kensler 2013: rounds of a bijection on the
/// next power of two, again while outside).
INLINE whole permute(uint index, uint count, whole seed) {
    uint bits = count - 1;
    bits |= bits >> 1;
    bits |= bits >> 2;
    bits |= bits >> 4;
    bits |= bits >> 8;
    bits |= bits >> 16;
    whole place = index;
    mask outside = (mask)(-1);
    do {
        whole next = place, key = seed;
        for (uint round = 0; round < 4; ++round) {
            next = (next * ((key << 1) | 1u)) & bits;
            next ^= (next >> 3) ^ ((key >> 16) & bits);
            next = (next + (key ^ (key >> 11))) & bits;
            key += 0x9e3779b9u;
        }
        place = CHOOSE(outside, next, place);
        outside = place >= count;
    } while (ANY(outside));
    return place;
}

/// floor(sqrt(x)), x < 2^22: whatever the last digits of the device's root are.
INLINE uint floor_root(uint x) {
    const uint root = (uint)(sqrt((float)x) + 0.5f);
    return root * root > x ? root - 1 : root;
}

/// A point in [0, 1)^2 for the integral number `dimension` of the sample.
INLINE void sample_square(const Sampler* sampler, whole dimension, real* u, real* v) {
#if SAMPLER == 0
    unit_reals(random_bits(random_bits(sampler->key, (whole)(sampler->sample)), dimension), u, v);
#else
    const wide of_dimension = random_bits(sampler->key, dimension);
#if SAMPLER == 1
    // columns * rows <= count, and what is left over is less than a row.
    const uint columns = floor_root(sampler->count), rows = sampler->count / columns;
    const whole cell = permute(sampler->sample % (columns * rows), columns * rows, TO_WHOLE(of_dimension));
    const whole row = cell / columns;
    unit_reals(random_bits(of_dimension, (whole)(sampler->sample)), u, v);
    // A sum may round up to the next cell, and in the last one to 1.
    *u = LESSER((TO_REAL(cell - row * columns) + *u) / (float)columns, (real)(BEFORE_ONE));
    *v = LESSER((TO_REAL(row) + *v) / (float)rows, (real)(BEFORE_ONE));
#else
    // Scrambled as a fraction, the index of a sample below 2^k stays in one aligned block of 2^k, whose points are a
    // net.
    const whole reversed = reverse_bits((whole)(sampler->sample));
    const whole index = reverse_bits(scramble_reversed(reversed, TO_WHOLE(of_dimension)));
    const whole seed = TO_WHOLE(of_dimension >> 32);
    *u = unit_real(reverse_bits(scramble_reversed(index, seed)));
    *v = unit_real(reverse_bits(scramble_reversed(sobol_second(index), mix_word(seed ^ TO_WHOLE(of_dimension)))));
#endif
#endif
}

#endif
