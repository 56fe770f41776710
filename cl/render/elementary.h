// SPDX-License-Identifier: MIT
// Logarithm and exponential, whose built-in functions differ between devices: these give the same bits on every device.
#ifndef BOXWOOD_RENDER_ELEMENTARY_H
#define BOXWOOD_RENDER_ELEMENTARY_H
#include "runtime/inline.h"
#include "runtime/numerics.h"

/// The logarithm to base 2 of x, positive and finite, to 1 unit in the last place; exact for powers of two.
INLINE float log2_of(float x) {
    const bool denormal = x < 0x1p-126f;
    // x = 2^exponent (1 + f), 1 + f from the root of a half to that of two.
    const int bits = as_int(denormal ? x * 0x1p24f : x) - 0x3f3504f3;
    const int exponent = (bits >> 23) - (denormal ? 24 : 0);
    const float f = as_float((bits & 0x007fffff) + 0x3f3504f3) - 1.0f;
    // Minimax polynomial of log2(1 + f); the logarithm of e in two floats.
    float p = fma(f, 0x1.8d65fcp-4f, -0x1.58fbf6p-3f);
    p = fma(f, p, 0x1.5fa17ap-3f);
    p = fma(f, p, -0x1.6e97a2p-3f);
    p = fma(f, p, 0x1.a414c8p-3f);
    p = fma(f, p, -0x1.ec7858p-3f);
    p = fma(f, p, 0x1.277f2ap-2f);
    p = fma(f, p, -0x1.715490p-2f);
    p = fma(f, p, 0x1.ec7088p-2f);
    p = fma(f, p, -0x1.715476p-1f);
    return (float)exponent + fma(f, 0x1.715476p+0f, f * fma(f, p, 0x1.4ae0c0p-26f));
}

/// 1 - e^-depth: what is lost on a way of a depth of 0 up to infinity, to 1 unit in the last place.
INLINE float absorbed_fraction(float depth) {
    const float d = LESSER(depth, 32.0f); // 1 from 17.4 on
    // e^-d = 2^-halvings e^x, |x| up to half of log 2, which is two floats.
    const float halvings = floor(fma(d, 0x1.715476p+0f, 0.5f));
    const float x = fma(halvings, -0x1.05c610p-29f, fma(halvings, 0x1.62e430p-1f, -d));
    // Minimax polynomial of e^x - 1.
    float p = fma(x, 0x1.a032c8p-13f, 0x1.6d7298p-10f);
    p = fma(x, p, 0x1.11118ap-7f);
    p = fma(x, p, 0x1.5554b0p-5f);
    p = fma(x, p, 0x1.555554p-3f);
    p = fma(x, p, 0.5f);
    const float scale = as_float((127 - (int)halvings) << 23);
    return fma(-scale, fma(x * x, p, x), 1.0f - scale);
}

#endif
