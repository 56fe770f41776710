// SPDX-License-Identifier: MIT
// Sine and cosine of a sampled azimuth, and the angle of a direction. The built-in functions differ between devices,
// and some are evaluated lane by lane; these give the same bits everywhere.
#ifndef BOXWOOD_RENDER_TURN_H
#define BOXWOOD_RENDER_TURN_H
#include "runtime/real.h"

/// Sine and cosine of 2 pi turns, turns in [0, 1], to 0.9 and 1.15 units in the last place.
INLINE void sincos_turn(real turns, real* sine, real* cosine) {
    // The nearest quarter, in the last bits of a sum; what is left, in [-1/2, 1/2] quarters, is exact.
    const real quarters = 4.0f * turns, shifted = quarters + 0x1.8p23f, rest = quarters - (shifted - 0x1.8p23f);
    const mask quarter = AS_INT(shifted), turned = (quarter & 1) != 0;
    const real square = rest * rest;
    // Minimax polynomials of sin and cos of (pi / 2) rest; pi / 2 in two floats.
    const real p = fma(square, fma(square, (real)(-0x1.2ddcecp-8f), (real)(0x1.46607ep-4f)), (real)(-0x1.4abbc0p-1f));
    const real odd = fma(rest, (real)(0x1.921fb6p+0f), rest * fma(square, p, (real)(-0x1.777a5cp-25f)));
    const real q = fma(square, fma(square, (real)(0x1.d47d5ep-11f), (real)(-0x1.55b146p-6f)), (real)(0x1.03c1aep-2f));
    const real even = fma(square, fma(square, q, (real)(-0x1.3bd3ccp+0f)), (real)(1.0f));
    // Signs: the sine's is that of the second half, the cosine's of the second and third quarter.
    *sine = AS_REAL(AS_INT(CHOOSE(turned, even, odd)) ^ ((quarter & 2) << 30));
    *cosine = AS_REAL(AS_INT(CHOOSE(turned, odd, even)) ^ (((quarter + 1) & 2) << 30));
}

/// The angle of (x, y), finite, from the x axis in half turns, in [-1, 1], to 1.7 units in the last place. Its sign is
/// that of y; on the axes and at zeros it is that of atan2pi(), and exact.
INLINE real atan2_pi(real y, real x) {
    const real across = fabs(x), upward = fabs(y);
    const real longer = GREATER(across, upward), shorter = LESSER(across, upward);
    const real slope = CHOOSE(longer > 0.0f, shorter / longer, (real)(0.0f)), square = slope * slope;
    // Minimax polynomial of atan(slope) / pi on [0, 1]; 1 / pi in two floats.
    real p = fma(square, (real)(-0x1.2b5334p-11f), (real)(0x1.c75e2ap-9f));
    p = fma(square, p, (real)(-0x1.4531a6p-7f));
    p = fma(square, p, (real)(0x1.2e4228p-6f));
    p = fma(square, p, (real)(-0x1.b6414ap-6f));
    p = fma(square, p, (real)(0x1.1d96a6p-5f));
    p = fma(square, p, (real)(-0x1.73f41ep-5f));
    p = fma(square, p, (real)(0x1.04bd94p-4f));
    p = fma(square, p, (real)(-0x1.b29942p-4f));
    real angle = fma(slope, (real)(0x1.45f306p-2f), slope * fma(square, p, (real)(0x1.b93910p-27f)));
    angle = CHOOSE(upward > across, 0.5f - angle, angle);
    angle = CHOOSE(AS_INT(x) < 0, 1.0f - angle, angle);
    return copysign(angle, y);
}

#endif
