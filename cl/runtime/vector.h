// SPDX-License-Identifier: MIT
// Vectors, symmetric matrices and frames of `real` lanes. Results go through pointers, for Oclgrind's sake.
#ifndef BOXWOOD_RUNTIME_VECTOR_H
#define BOXWOOD_RUNTIME_VECTOR_H
#include "runtime/real.h"

typedef struct Vector {
    real x, y, z;
} Vector;

typedef struct Symmetric {
    real xx, yy, zz, xy, xz, yz;
} Symmetric;

/// Three axes, orthonormal and right-handed where nothing else is said.
typedef struct Frame {
    Vector a, b, c;
} Frame;

INLINE real dot3(const Vector* p, const Vector* q) { return fma(p->x, q->x, fma(p->y, q->y, p->z * q->z)); }

/// sum |p_i q_i|: what bounds the rounding of dot3, and the reach of a box along an axis.
INLINE real reach3(const Vector* p, const Vector* q) {
    return fma(fabs(p->x), fabs(q->x), fma(fabs(p->y), fabs(q->y), fabs(p->z * q->z)));
}

INLINE void cross3(const Vector* p, const Vector* q, Vector* result) {
    const Vector r = {fma(p->y, q->z, -(p->z * q->y)), fma(p->z, q->x, -(p->x * q->z)),
                      fma(p->x, q->y, -(p->y * q->x))};
    *result = r;
}

INLINE void add3(const Vector* p, const Vector* q, Vector* result) {
    const Vector r = {p->x + q->x, p->y + q->y, p->z + q->z};
    *result = r;
}

INLINE void subtract3(const Vector* p, const Vector* q, Vector* result) {
    const Vector r = {p->x - q->x, p->y - q->y, p->z - q->z};
    *result = r;
}

/// Component by component.
INLINE void multiply3(const Vector* p, const Vector* q, Vector* result) {
    const Vector r = {p->x * q->x, p->y * q->y, p->z * q->z};
    *result = r;
}

/// p q - r s to two roundoffs, and 0 where it is (Kahan; Jeannerod et al. 2013): products lose nothing to each other.
INLINE real difference_of_products(real p, real q, real r, real s) {
    const real product = r * s;
    return fma(p, q, -product) - fma(r, s, -product);
}

/// The cross product, every component to two roundoffs of itself: zero for vectors along one line, and for no others.
INLINE void exact_cross3(const Vector* p, const Vector* q, Vector* result) {
    const Vector r = {difference_of_products(p->y, q->z, p->z, q->y), difference_of_products(p->z, q->x, p->x, q->z),
                      difference_of_products(p->x, q->y, p->y, q->x)};
    *result = r;
}

INLINE void scale3(real factor, Vector* v) {
    v->x *= factor;
    v->y *= factor;
    v->z *= factor;
}

/// v += factor * p
INLINE void add_scaled3(real factor, const Vector* p, Vector* v) {
    v->x = fma(factor, p->x, v->x);
    v->y = fma(factor, p->y, v->y);
    v->z = fma(factor, p->z, v->z);
}

INLINE real larger(real p, real q) { return GREATER(p, q); }

INLINE real smaller(real p, real q) { return LESSER(p, q); }

INLINE real largest3(const Vector* v) { return larger(fabs(v->x), larger(fabs(v->y), fabs(v->z))); }

/// Length 1, unless v is zero, which stays. No overflow or underflow of squares: the largest component must be near 1.
INLINE void normalise3(Vector* v) {
    const real square = dot3(v, v);
    scale3(CHOOSE(square > 0.0f, 1.0f / sqrt(square), (real)(0.0f)), v);
}

INLINE void choose3(mask condition, const Vector* yes, Vector* v) {
    v->x = CHOOSE(condition, yes->x, v->x);
    v->y = CHOOSE(condition, yes->y, v->y);
    v->z = CHOOSE(condition, yes->z, v->z);
}

/// The first three floats of the row that each lane's index names.
INLINE void load_vectors(global const float* base, uint stride, const uint* index, Vector* v) {
    real row[8];
    load_rows3(base, stride, index, row);
    const Vector r = {row[0], row[1], row[2]};
    *v = r;
}

/// The same in every lane.
INLINE void spread3(float3 value, Vector* v) {
    v->x = value.x;
    v->y = value.y;
    v->z = value.z;
}

/// The reverse, lane after lane, for the first `count` lanes.
INLINE void store_vectors(const Vector* v, global float* base, uint stride, const uint* index, uint count) {
    real row[8];
    row[0] = v->x;
    row[1] = v->y;
    row[2] = v->z;
    store_rows3(row, base, stride, index, count);
}

INLINE void choose6(mask condition, const Symmetric* yes, Symmetric* m) {
    m->xx = CHOOSE(condition, yes->xx, m->xx);
    m->yy = CHOOSE(condition, yes->yy, m->yy);
    m->zz = CHOOSE(condition, yes->zz, m->zz);
    m->xy = CHOOSE(condition, yes->xy, m->xy);
    m->xz = CHOOSE(condition, yes->xz, m->xz);
    m->yz = CHOOSE(condition, yes->yz, m->yz);
}

INLINE void identity_frame(Frame* frame) {
    const real one = 1.0f, zero = 0.0f;
    const Vector x = {one, zero, zero}, y = {zero, one, zero}, z = {zero, zero, one};
    frame->a = x;
    frame->b = y;
    frame->c = z;
}

/// Makes rows that are nearly orthonormal so to rounding, and right-handed: the third follows from the first two.
/// Entries of F F^T - I are then at most 24 roundoffs: 8 for the length of a row, 3 for each dot product and its use,
/// and those of the cross product (10 were the most seen).
INLINE void orthonormalise(Frame* frame) {
    normalise3(&frame->a);
    add_scaled3(-dot3(&frame->a, &frame->b), &frame->a, &frame->b);
    normalise3(&frame->b);
    cross3(&frame->a, &frame->b, &frame->c);
}

/// The power of two at or below each positive value, at least the smallest normal one.
INLINE real power_below(real value) {
    // Of two masks: Oclgrind 21.10 reads behind the scalar in max(int8, int).
    return AS_REAL(max(AS_INT(value) & 0x7f800000, (mask)(0x00800000)));
}

/// 1 / power, exact, for powers of two from 2^-126 to 2^126.
INLINE real inverse_power(real power) { return AS_REAL(0x7f000000 - AS_INT(power)); }

/// A power of two that brings any positive value to where the inverse of power_below() is a normal float; 1 but for
/// denormal numbers and those from 2^127 up. Zero stays.
INLINE real off_the_ends(real value) {
    return CHOOSE(value < 0x1p-126f, (real)(0x1p24f), CHOOSE(value >= 0x1p127f, (real)(0.5f), (real)(1.0f)));
}

/// v times a power of two that brings its largest component near 1, so that squares and products stay in range. Zero
/// stays.
INLINE void scale_to_one3(Vector* v) { scale3(inverse_power(smaller(power_below(largest3(v)), (real)(0x1p126f))), v); }

/// Length 1 for any magnitude, unless v is zero, which stays.
INLINE void normalise_any3(Vector* v) {
    scale_to_one3(v);
    normalise3(v);
}

#endif
