// SPDX-License-Identifier: MIT
// First and second moments of weighted points, merged pairwise (Chan, Golub and LeVeque 1979): the mean is an offset
// from a reference near the points and the second moment is about the mean, so nothing cancels far from the origin.
#ifndef BOXWOOD_BOUNDS_MOMENTS_H
#define BOXWOOD_BOUNDS_MOMENTS_H
#include "runtime/vector.h"

typedef struct Moments {
    Vector mean;          ///< Less the reference.
    Symmetric covariance; ///< Mean of (p - mean)(p - mean)^T.
} Moments;

/// m += factor * v v^T
INLINE void add_outer(real factor, const Vector* v, Symmetric* m) {
    const real x = factor * v->x, y = factor * v->y, z = factor * v->z;
    m->xx = fma(x, v->x, m->xx);
    m->yy = fma(y, v->y, m->yy);
    m->zz = fma(z, v->z, m->zz);
    m->xy = fma(x, v->y, m->xy);
    m->xz = fma(x, v->z, m->xz);
    m->yz = fma(y, v->z, m->yz);
}

/// Joins `other`, whose points have the part `weight` (0 to 1) of the weight of both. Both means have the same
/// reference.
INLINE void merge_moments(real weight, const Moments* other, Moments* m) {
    const Vector between = {other->mean.x - m->mean.x, other->mean.y - m->mean.y, other->mean.z - m->mean.z};
    add_scaled3(weight, &between, &m->mean);
    const real rest = 1.0f - weight;
    m->covariance.xx = fma(weight, other->covariance.xx, rest * m->covariance.xx);
    m->covariance.yy = fma(weight, other->covariance.yy, rest * m->covariance.yy);
    m->covariance.zz = fma(weight, other->covariance.zz, rest * m->covariance.zz);
    m->covariance.xy = fma(weight, other->covariance.xy, rest * m->covariance.xy);
    m->covariance.xz = fma(weight, other->covariance.xz, rest * m->covariance.xz);
    m->covariance.yz = fma(weight, other->covariance.yz, rest * m->covariance.yz);
    add_outer(weight * rest, &between, &m->covariance);
}

/// The moments under p' = factor * p + shift.
INLINE void move_moments(real factor, const Vector* shift, Moments* m) {
    Vector mean = *shift;
    add_scaled3(factor, &m->mean, &mean);
    m->mean = mean;
    const real square = factor * factor;
    m->covariance.xx *= square;
    m->covariance.yy *= square;
    m->covariance.zz *= square;
    m->covariance.xy *= square;
    m->covariance.xz *= square;
    m->covariance.yz *= square;
}

#endif
