// SPDX-License-Identifier: MIT
#ifndef BOXWOOD_SHARED_PATH_H
#define BOXWOOD_SHARED_PATH_H
#include "shared/types.h"

BOXWOOD_SHARED_BEGIN

/// A path that goes on, beside its ray.
typedef struct PathState {
    float throughput[3]; ///< What a unit of radiance along the ray adds to the pixel.
    float pdf;           ///< Density, by solid angle, with which the surface drew the ray's direction.
    uint pixel;          ///< Index within the batch.
    /// Bounces so far, at most 64; from bit 8 on, modulo 2^24, surfaces passed that stop a part of the light.
    uint counts;
    float width;  ///< Of the beam at the ray's origin,
    float spread; ///< and what it grows by per distance.
} PathState;
BOXWOOD_SHARED_SIZE(PathState, 32)

/// What a shadow ray brings to a pixel if it meets nothing.
typedef struct ShadowLight {
    float value[3];
    uint pixel; ///< Index within the batch, and BOXWOOD_INDIRECT; BOXWOOD_NONE: there is no ray.
} ShadowLight;
BOXWOOD_SHARED_SIZE(ShadowLight, 16)

// Set in ShadowLight::pixel for light that is reflected more than once.
#define BOXWOOD_INDIRECT 0x80000000u

// After so many surfaces that let light pass, a shadow ray passes more by chance: as bright on average, but never long
// dim.
#define BOXWOOD_SURE_LAYERS 64u

BOXWOOD_SHARED_END
#endif
