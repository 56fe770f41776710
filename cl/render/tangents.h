// SPDX-License-Identifier: MIT
// A frame around a direction.
#ifndef BOXWOOD_RENDER_TANGENTS_H
#define BOXWOOD_RENDER_TANGENTS_H
#include "runtime/inline.h"
#include "runtime/numerics.h"

/// Two directions that with the normalised `n` are orthonormal, by Duff et al. 2017: without a branch, and without a loss of
/// digits near any pole.
INLINE void tangents_of(float3 n, float3* tangent, float3* bitangent) {
    const float sign = copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    *tangent = (float3)(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x);
    *bitangent = (float3)(b, sign + n.y * n.y * a, -n.y);
}

#endif
