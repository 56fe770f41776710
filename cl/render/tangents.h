// SPDX-License-Identifier: MIT
// A frame around a direction.
#ifndef BOXWOOD_RENDER_TANGENTS_H
#define BOXWOOD_RENDER_TANGENTS_H
#include "runtime/vector.h"

/// Two directions that with the normalised `n` are orthonormal, by Duff et al. 2017: without a branch, and without a
/// loss of digits near any pole.
INLINE void tangents_of(const Vector* n, Vector* tangent, Vector* bitangent) {
    const real sign = copysign((real)(1.0f), n->z);
    const real a = -1.0f / (sign + n->z);
    const real b = n->x * n->y * a;
    const Vector t = {1.0f + sign * n->x * n->x * a, sign * b, -sign * n->x};
    const Vector u = {b, sign + n->y * n->y * a, -n->y};
    *tangent = t;
    *bitangent = u;
}

#endif
