// SPDX-License-Identifier: MIT
// Eigenvectors of symmetric 3x3 matrices by Jacobi's method (Golub and Van Loan, 8.5): a bounded number of plane
// rotations, each orthogonal whatever the matrix, so repeated and zero eigenvalues need no special case.
#ifndef BOXWOOD_BOUNDS_EIGEN_H
#define BOXWOOD_BOUNDS_EIGEN_H
#include "runtime/vector.h"

// JACOBI_SWEEPS  Converges quadratically: four sweeps take the entries off the diagonal of any float matrix below the
//                rounding of those on it, the fifth is for the worst found by search. Where only the size of a box
//                depends on it two or three will do: whoever defines it says what that costs.
#ifndef JACOBI_SWEEPS
#define JACOBI_SWEEPS 5
#endif

/// Entries off the diagonal vanish quadratically. Beside the largest entry, which is 1, one below 2^-60 is far beyond
/// the rounding of the matrix, and its products would be denormal, which is slow: it is taken for zero.
INLINE real without_dust(real entry) { return CHOOSE(fabs(entry) > 0x1p-60f, entry, (real)(0.0f)); }

/// Rotates rows p and q of the frame so that the entry `pq` of the matrix becomes zero. `rp`, `rq` are the other
/// entries of the rows, in the third row.
INLINE void jacobi_rotate(real* pp, real* qq, real* pq, real* rp, real* rq, Vector* p, Vector* q) {
    const real difference = *qq - *pp;
    const real twice = 2.0f * *pq;
    const real length = fabs(difference) + sqrt(fma(difference, difference, twice * twice));
    const real t =
        CHOOSE(length > 0.0f, copysign(twice / length, twice * copysign((real)(1.0f), difference)), (real)(0.0f));
    const real c = 1.0f / sqrt(fma(t, t, (real)(1.0f)));
    const real s = t * c;
    *pp = fma(-t, *pq, *pp);
    *qq = fma(t, *pq, *qq);
    *pq = 0.0f;
    const real r = *rp;
    *rp = without_dust(fma(c, r, -(s * *rq)));
    *rq = without_dust(fma(s, r, c * *rq));
    const Vector old = *p;
    scale3(c, p);
    add_scaled3(-s, q, p);
    scale3(c, q);
    add_scaled3(s, &old, q);
}

INLINE void order_axes(real* first, real* second, Vector* p, Vector* q) {
    const mask swapped = *first < *second;
    const real lesser = CHOOSE(swapped, *first, *second);
    *first = CHOOSE(swapped, *second, *first);
    *second = lesser;
    const Vector old = *p;
    choose3(swapped, q, p);
    choose3(swapped, &old, q);
}

/// Eigenvectors of any finite `matrix` as rows of `frame`, by descending eigenvalue; of a zero matrix the identity.
/// With repeated eigenvalues some orthonormal choice. The matrix times a power of two has the same ones, to the bit,
/// unless its entries lose digits by that.
INLINE void eigenvectors(const Symmetric* matrix, Frame* frame) {
    Symmetric m = *matrix;
    real largest = larger(larger(fabs(m.xx), fabs(m.yy)), fabs(m.zz));
    largest = larger(larger(largest, fabs(m.xy)), larger(fabs(m.xz), fabs(m.yz)));
    // By two factors, as their product need not be a float.
    const real nearer = off_the_ends(largest), scale = inverse_power(power_below(nearer * largest));
    m.xx = nearer * m.xx * scale;
    m.yy = nearer * m.yy * scale;
    m.zz = nearer * m.zz * scale;
    m.xy = without_dust(nearer * m.xy * scale);
    m.xz = without_dust(nearer * m.xz * scale);
    m.yz = without_dust(nearer * m.yz * scale);
    identity_frame(frame);
    for (int sweep = 0; sweep < JACOBI_SWEEPS; ++sweep) {
        jacobi_rotate(&m.xx, &m.yy, &m.xy, &m.xz, &m.yz, &frame->a, &frame->b);
        jacobi_rotate(&m.xx, &m.zz, &m.xz, &m.xy, &m.yz, &frame->a, &frame->c);
        jacobi_rotate(&m.yy, &m.zz, &m.yz, &m.xy, &m.xz, &frame->b, &frame->c);
    }
    order_axes(&m.xx, &m.yy, &frame->a, &frame->b);
    order_axes(&m.yy, &m.zz, &frame->b, &frame->c);
    order_axes(&m.xx, &m.yy, &frame->a, &frame->b);
    orthonormalise(frame);
}

#endif
