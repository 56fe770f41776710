// SPDX-License-Identifier: MIT
// Adds the light of a sample to its pixel.
#ifndef BOXWOOD_RENDER_PATH_SUM_H
#define BOXWOOD_RENDER_PATH_SUM_H
#include "runtime/inline.h"
#include "runtime/numerics.h"
#include "shared/path.h"

/// Adds light that is finite and not negative; so is the sum.
INLINE void add_light(float3 light, global float* sum) {
    const float3 total = vload3(0, sum) + light;
    vstore3(LESSER(total, (float3)(FLT_MAX)), 0, sum);
}

/// Adds what a shadow ray that met nothing stands for to its pixel.
INLINE void add_shadow_light(global const ShadowLight* light, global float* direct, global float* indirect) {
    const size_t pixel = light->pixel & ~BOXWOOD_INDIRECT;
    add_light(vload3(0, light->value), (light->pixel & BOXWOOD_INDIRECT ? indirect : direct) + 3 * pixel);
}

#endif
