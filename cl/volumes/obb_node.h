// SPDX-License-Identifier: MIT
// Access to the points and moments of a node, for the kernels of oriented boxes.
//
// POINTS_PER_PRIMITIVE  3: triangles, whose vertices are as they are; 8: instances, whose corners were rounded
#ifndef BOXWOOD_VOLUMES_OBB_NODE_H
#define BOXWOOD_VOLUMES_OBB_NODE_H
#include "bounds/moments.h"
#include "bounds/oriented_box.h"
#include "volumes/ranges.h"

#if POINTS_PER_PRIMITIVE != 3 && POINTS_PER_PRIMITIVE != 8
#error "define POINTS_PER_PRIMITIVE (3 or 8)"
#endif

/// The nodes' arrays that the kernels share.
typedef struct Nodes {
    global const Aabb* aabbs;   ///< 2n
    global const float* points; ///< x of all points by sorted position, then y, then z; `stride` apart.
    uint stride;
    global const float*
        errors; ///< 4 per node: how far its points may be off, in each coordinate, and 0. 8 points only.
    uint count; ///< n
} Nodes;

/// How far from its triangle a hit may lie, along each axis, in a node's space: 17 roundoffs of the triangle's longest
/// extent (traverse/ray_triangle.h), which is less than two units.
INLINE void hit_error(Vector* error) {
    const Vector isotropic = {36.0f * ROUNDOFF, 36.0f * ROUNDOFF, 36.0f * ROUNDOFF};
    *error = isotropic;
}

/// The error of the points below, or of hits there, in the node's space.
INLINE void inexact_of(const Nodes* nodes, const uint* index, const Space* space, Vector* inexact) {
#if POINTS_PER_PRIMITIVE == 8
    real v[8];
    load_rows4(nodes->errors, 4, index, v);
    const Vector error = {v[0], v[1], v[2]};
    *inexact = error;
    scale3(space->inverse_unit, inexact);
#else
    hit_error(inexact);
#endif
}

/// The points of the primitives at LANES sorted positions. Reads behind them, where the array has room for it.
INLINE void load_primitives_at(const Nodes* nodes, const uint* positions, const Space* space, Vector* points) {
    real x[8], y[8], z[8];
#if POINTS_PER_PRIMITIVE == 8
    load_rows8(nodes->points, 8, positions, x);
    load_rows8(nodes->points + nodes->stride, 8, positions, y);
    load_rows8(nodes->points + 2 * (size_t)nodes->stride, 8, positions, z);
#else
    load_rows4(nodes->points, 3, positions, x);
    load_rows4(nodes->points + nodes->stride, 3, positions, y);
    load_rows4(nodes->points + 2 * (size_t)nodes->stride, 3, positions, z);
#endif
    for (uint k = 0; k < POINTS_PER_PRIMITIVE; ++k) {
        const Vector p = {x[k], y[k], z[k]};
        to_space(space, &p, &points[k]);
    }
}

/// Moments of the points of one primitive.
INLINE void primitive_moments(const Vector* points, Moments* moments) {
    const Vector none = {0.0f, 0.0f, 0.0f};
    const Symmetric zero = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
    const real share = 1.0f / POINTS_PER_PRIMITIVE;
    moments->mean = none;
    moments->covariance = zero;
    for (uint k = 0; k < POINTS_PER_PRIMITIVE; ++k) add_scaled3(share, &points[k], &moments->mean);
    for (uint k = 0; k < POINTS_PER_PRIMITIVE; ++k) {
        Vector p = points[k];
        add_scaled3((real)(-1.0f), &moments->mean, &p);
        add_outer(share, &p, &moments->covariance);
    }
}

/// BOXWOOD_MOMENT_FLOATS per node, in the node's own space: mean, covariance, zeros.
INLINE void load_moments(global const float* base, const uint* index, Moments* moments) {
    real v[8], w[8];
    load_rows8(base, BOXWOOD_MOMENT_FLOATS, index, v);
    load_rows4(base + 8, BOXWOOD_MOMENT_FLOATS, index, w);
    const Vector mean = {v[0], v[1], v[2]};
    const Symmetric covariance = {v[3], v[4], v[5], v[6], v[7], w[0]};
    moments->mean = mean;
    moments->covariance = covariance;
}

INLINE void store_moments(const Moments* moments, global float* base, const uint* index, uint count) {
    const Symmetric* m = &moments->covariance;
    real v[8] = {moments->mean.x, moments->mean.y, moments->mean.z, m->xx, m->yy, m->zz, m->xy, m->xz};
    real w[8] = {m->yz, 0.0f, 0.0f, 0.0f};
    store_rows8(v, base, BOXWOOD_MOMENT_FLOATS, index, count);
    store_rows4(w, base + 8, BOXWOOD_MOMENT_FLOATS, index, count);
}

/// Takes moments from the space of one node to that of another.
INLINE void change_space(const Space* from, const Space* to, Moments* moments) {
    Vector shift;
    to_space(to, &from->origin, &shift);
    move_moments(from->unit * to->inverse_unit, &shift, moments);
}

/// Moments of a box's 8 corners: the mean of h^2 a a^T over its axes.
INLINE void box_moments(const OrientedBox* box, Moments* moments) {
    const Symmetric zero = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
    moments->mean = box->center;
    moments->covariance = zero;
    add_outer(box->extent.x * box->extent.x, &box->axes.a, &moments->covariance);
    add_outer(box->extent.y * box->extent.y, &box->axes.b, &moments->covariance);
    add_outer(box->extent.z * box->extent.z, &box->axes.c, &moments->covariance);
}

#endif
