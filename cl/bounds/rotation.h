// SPDX-License-Identifier: MIT
// Rotations as unit quaternions: of frames, half-way between the frames of two boxes (dissertation 3.5, third
// algorithm), and the rotation in any matrix (Mueller, Bender, Chentanez and Macklin 2016).
#ifndef BOXWOOD_BOUNDS_ROTATION_H
#define BOXWOOD_BOUNDS_ROTATION_H
#include "bounds/eigen.h"
#include "runtime/vector.h"

typedef struct Quaternion {
    real x, y, z, w;
} Quaternion;

INLINE real dot4(const Quaternion* p, const Quaternion* q) {
    return fma(p->x, q->x, fma(p->y, q->y, fma(p->z, q->z, p->w * q->w)));
}

/// Length 1; zero becomes the identity. The largest component must be near 1.
INLINE void normalise4(Quaternion* q) {
    const real square = dot4(q, q);
    const real factor = CHOOSE(square > 0.0f, 1.0f / sqrt(square), (real)(0.0f));
    q->x *= factor;
    q->y *= factor;
    q->z *= factor;
    q->w = CHOOSE(square > 0.0f, q->w * factor, (real)(1.0f));
}

INLINE void choose4(mask condition, const Quaternion* yes, Quaternion* q) {
    q->x = CHOOSE(condition, yes->x, q->x);
    q->y = CHOOSE(condition, yes->y, q->y);
    q->z = CHOOSE(condition, yes->z, q->z);
    q->w = CHOOSE(condition, yes->w, q->w);
}

/// p q: first q, then p.
INLINE void multiply4(const Quaternion* p, const Quaternion* q, Quaternion* result) {
    const Quaternion r = {fma(p->w, q->x, fma(p->x, q->w, fma(p->y, q->z, -(p->z * q->y)))),
                          fma(p->w, q->y, fma(p->y, q->w, fma(p->z, q->x, -(p->x * q->z)))),
                          fma(p->w, q->z, fma(p->z, q->w, fma(p->x, q->y, -(p->y * q->x)))),
                          fma(p->w, q->w, -fma(p->x, q->x, fma(p->y, q->y, p->z * q->z)))};
    *result = r;
}

INLINE void conjugate4(Quaternion* q) {
    q->x = -q->x;
    q->y = -q->y;
    q->z = -q->z;
}

/// The rotation that turns the axes of the world into those of an orthonormal, right-handed frame. One component is at
/// least 1/2; its square is on the diagonal, and the others follow from it without cancellation (Shepperd 1978). Of
/// equal ones the first of w, x, y, z is taken.
INLINE void quaternion_of(const Frame* frame, Quaternion* q) {
    const real ax = frame->a.x, by = frame->b.y, cz = frame->c.z;
    const real dx = frame->b.z - frame->c.y, dy = frame->c.x - frame->a.z, dz = frame->a.y - frame->b.x;
    const real sx = frame->b.z + frame->c.y, sy = frame->c.x + frame->a.z, sz = frame->a.y + frame->b.x;
    const Quaternion by_w = {dx, dy, dz, 1.0f + ax + by + cz};
    const Quaternion by_x = {1.0f + ax - by - cz, sz, sy, dx};
    const Quaternion by_y = {sz, 1.0f - ax + by - cz, sx, dy};
    const Quaternion by_z = {sy, sx, 1.0f - ax - by + cz, dz};
    Quaternion best = by_w;
    real largest = by_w.w;
    const mask x_leads = by_x.x > largest;
    choose4(x_leads, &by_x, &best);
    largest = larger(by_x.x, largest);
    const mask y_leads = by_y.y > largest;
    choose4(y_leads, &by_y, &best);
    largest = larger(by_y.y, largest);
    choose4(by_z.z > largest, &by_z, &best);
    normalise4(&best);
    *q = best;
}

/// The world's axes, turned by a unit quaternion.
INLINE void frame_of(const Quaternion* q, Frame* frame) {
    const real x = q->x + q->x, y = q->y + q->y, z = q->z + q->z;
    const Vector a = {1.0f - fma(q->y, y, q->z * z), fma(q->x, y, q->w * z), fma(q->x, z, -(q->w * y))};
    const Vector b = {fma(q->x, y, -(q->w * z)), 1.0f - fma(q->x, x, q->z * z), fma(q->y, z, q->w * x)};
    const Vector c = {fma(q->x, z, q->w * y), fma(q->y, z, -(q->w * x)), 1.0f - fma(q->x, x, q->y * y)};
    frame->a = a;
    frame->b = b;
    frame->c = c;
}

/// 1 where `first` is the larger or both are equal, else 0.
INLINE real leads(real first, real second) { return CHOOSE(first >= second, (real)(1.0f), (real)(0.0f)); }

INLINE real with_sign_of(real magnitude, real sign) { return CHOOSE(sign < 0.0f, -magnitude, magnitude); }

/// The rotation of the cube that is nearest to a rotation r, as the unit quaternion h of largest dot product with r.
/// The 24 rotations of the cube are the 48 quaternions that have one component of 1, two of 1/sqrt(2), or four of 1/2,
/// with any signs: h has the signs of r, and of the three kinds the one where the sum of its components of r is
/// largest. Ties go to the first of w, x, y, z and to fewer components, so that no relabelling wins over any other as
/// near.
INLINE void nearest_cube_rotation(const Quaternion* r, Quaternion* h) {
    const real x = fabs(r->x), y = fabs(r->y), z = fabs(r->z), w = fabs(r->w);
    const real wx = leads(w, x), wy = leads(w, y), wz = leads(w, z);
    const real xy = leads(x, y), xz = leads(x, z), yz = leads(y, z);
    // How many of the other three each one leads: 3 for the largest, 2 for the second.
    const real w_led = wx + wy + wz, x_led = 1.0f - wx + xy + xz;
    const real y_led = 2.0f - wy - xy + yz, z_led = 3.0f - wz - xz - yz;
    const real largest = larger(larger(w, x), larger(y, z));
    const real middle_low = larger(smaller(w, x), smaller(y, z)), middle_high = smaller(larger(w, x), larger(y, z));
    const real two = 0x1.6a09e6p-1f * (largest + larger(middle_low, middle_high));
    const real four = 0.5f * ((w + x) + (y + z));
    const mask pair = two > largest, all = four > larger(two, largest);
    // A component is taken when it leads at least so many.
    const real enough = CHOOSE(all, (real)(0.0f), CHOOSE(pair, (real)(2.0f), (real)(3.0f)));
    const real size = CHOOSE(all, (real)(0.5f), CHOOSE(pair, (real)(0x1.6a09e6p-1f), (real)(1.0f)));
    const real none = 0.0f;
    h->x = with_sign_of(CHOOSE(x_led >= enough, size, none), r->x);
    h->y = with_sign_of(CHOOSE(y_led >= enough, size, none), r->y);
    h->z = with_sign_of(CHOOSE(z_led >= enough, size, none), r->z);
    h->w = with_sign_of(CHOOSE(w_led >= enough, size, none), r->w);
}

/// The rotation half-way from p to q as orientations of boxes: q is first matched with -q and with the 24 ways to label
/// a box's axes, and the one nearest to p is taken. That is at most 62.8 degrees away, so the sum never cancels.
INLINE void blend_rotations(const Quaternion* p, const Quaternion* q, Quaternion* result) {
    Quaternion inverse = *p, between, nearest, matched;
    conjugate4(&inverse);
    multiply4(&inverse, q, &between);
    nearest_cube_rotation(&between, &nearest);
    conjugate4(&nearest);
    multiply4(q, &nearest, &matched);
    matched.x += p->x;
    matched.y += p->y;
    matched.z += p->z;
    matched.w += p->w;
    normalise4(&matched);
    *result = matched;
}

/// The frame half-way between the frames of two boxes.
INLINE void blend_frames(const Frame* p, const Frame* q, Frame* result) {
    Quaternion of_p, of_q, between;
    quaternion_of(p, &of_p);
    quaternion_of(q, &of_q);
    blend_rotations(&of_p, &of_q, &between);
    frame_of(&between, result);
}

// Up to two to leave saddles, then convergence is quadratic: the tests reach rounding with five.
#define ROTATION_STEPS 8

/// What one step of extract_rotation turns about, in the frame of R. S is the symmetric part of B = R^T A and `turn`
/// its axial vector, the axis of the paper. Along the eigenvectors of S the curvature of trace(R^T A) is S's eigenvalue
/// less the trace; the axis is weighted by its inverse, as in Newton's method. Where a curvature has the wrong sign the
/// step is about that eigenvector alone.
INLINE void turning_axis(const Symmetric* s, const Vector* turn, Vector* axis) {
    Frame eigen;
    eigenvectors(s, &eigen);
    const real trace = s->xx + s->yy + s->zz;
    const Vector* directions[3] = {&eigen.a, &eigen.b, &eigen.c};
    Vector weighted = {0.0f, 0.0f, 0.0f};
    mask saddle = AS_INT(trace) != AS_INT(trace);
    for (int k = 0; k < 3; ++k) {
        const Vector* n = directions[k];
        const Vector image = {fma(s->xx, n->x, fma(s->xy, n->y, s->xz * n->z)),
                              fma(s->xy, n->x, fma(s->yy, n->y, s->yz * n->z)),
                              fma(s->xz, n->x, fma(s->yz, n->y, s->zz * n->z))};
        const real curvature = trace - dot3(n, &image);
        if (k == 0) saddle = curvature < -16.0f * 0x1p-24f;
        // Below rounding the turn about this axis does not matter.
        add_scaled3(dot3(n, turn) / larger(fabs(curvature), (real)(0x1p-20f)), n, &weighted);
    }
    choose3(saddle, &eigen.a, &weighted);
    const real size = largest3(&weighted);
    scale3(CHOOSE(size > 0.0f, 1.0f / size, (real)(0.0f)), &weighted);
    normalise3(&weighted);
    *axis = weighted;
}

/// The rotation R in a finite matrix A with the columns of `matrix`: the one of largest trace(R^T A), which is the
/// nearest in the Frobenius norm. Where that is not unique (rank below two, some reflections) one of the nearest. `q`:
/// on entry where to start, a unit quaternion; any will do. Mueller et al. 2016 turn R about the axis of R^T A by an
/// angle that is right near the end only, and stand still when R is exactly 180 degrees off. Here the angle is the best
/// one about the axis, and saddles, such as that one, are left about the axis along which they fall off. The matrix is
/// scaled by a power of two, so that its size does not matter, from denormal numbers to FLT_MAX; zero gives the start.
INLINE void extract_rotation(const Frame* matrix, Quaternion* q) {
    Frame m = *matrix;
    const real size = larger(largest3(&m.a), larger(largest3(&m.b), largest3(&m.c)));
    const real nearer = off_the_ends(size), scale = inverse_power(power_below(nearer * size));
    Vector* const columns[3] = {&m.a, &m.b, &m.c};
    for (int k = 0; k < 3; ++k) {
        // By two factors, as their product need not be a float.
        scale3(nearer, columns[k]);
        scale3(scale, columns[k]);
    }
    mask moving = AS_INT(scale) == AS_INT(scale);
    for (int step = 0; step < ROTATION_STEPS && ANY(moving); ++step) {
        Frame r;
        frame_of(q, &r);
        const real xy = dot3(&r.a, &m.b), yx = dot3(&r.b, &m.a), xz = dot3(&r.a, &m.c), zx = dot3(&r.c, &m.a);
        const real yz = dot3(&r.b, &m.c), zy = dot3(&r.c, &m.b);
        const Symmetric s = {dot3(&r.a, &m.a), dot3(&r.b, &m.b), dot3(&r.c, &m.c),
                             0.5f * (xy + yx), 0.5f * (xz + zx), 0.5f * (yz + zy)};
        const Vector turn = {zy - yz, xz - zx, yx - xy};
        Vector axis;
        turning_axis(&s, &turn, &axis);
        // Turned by an angle t about the axis the trace is a constant plus c cos(t) + d sin(t).
        const Vector image = {fma(s.xx, axis.x, fma(s.xy, axis.y, s.xz * axis.z)),
                              fma(s.xy, axis.x, fma(s.yy, axis.y, s.yz * axis.z)),
                              fma(s.xz, axis.x, fma(s.yz, axis.y, s.zz * axis.z))};
        const real c = s.xx + s.yy + s.zz - dot3(&axis, &image), d = dot3(&axis, &turn);
        const real length = sqrt(fma(c, c, d * d));
        // Half of the best angle, by the form that does not cancel.
        const mask beyond = c < 0.0f;
        const real cosine = CHOOSE(beyond, fabs(d), length + c);
        const real sine = CHOOSE(beyond, with_sign_of(length - c, d), d);
        Quaternion by = {sine * axis.x, sine * axis.y, sine * axis.z, cosine};
        const real most = larger(fabs(sine), cosine);
        const real factor = CHOOSE(most > 0.0f, 1.0f / most, (real)(0.0f));
        by.x *= factor;
        by.y *= factor;
        by.z *= factor;
        by.w *= factor;
        normalise4(&by);
        Quaternion turned;
        multiply4(q, &by, &turned);
        normalise4(&turned);
        // A lane that stands still does so for good, so that its result is the same in any company.
        moving = (moving != 0) & (fabs(by.x) + fabs(by.y) + fabs(by.z) > 2.0f * 0x1p-24f);
        choose4(moving, &turned, q);
    }
}

#endif
