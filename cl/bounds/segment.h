// SPDX-License-Identifier: MIT
// The elements of segments: points or triangles, their weights and ends.
//
// CORNERS  vertices per element: 1 for points, 3 for triangles
#ifndef BOXWOOD_BOUNDS_SEGMENT_H
#define BOXWOOD_BOUNDS_SEGMENT_H
#include "bounds/eigen.h"
#include "bounds/moments.h"
#include "bounds/oriented_box.h"
#include "primitives/segments.h"

// Eigenvalues this close, relative to the larger, are close: random samples of a shape with a repeated one, some
// hundreds of them, are as far apart.
#define CLOSE 0.125f

/// The vertex that is corner k of element i.
INLINE uint vertex_of(global const uint* triangles, uint i, int k) {
    return CORNERS == 1 ? i : triangles[CORNERS * (size_t)i + k];
}

INLINE void load_vertex(global const float* positions, uint vertex, Vector* p) {
    const float3 v = vload3(vertex, positions);
    p->x = v.x;
    p->y = v.y;
    p->z = v.z;
}

INLINE void load_element(global const float* positions, global const uint* triangles, uint i, Vector* corners) {
    for (int k = 0; k < CORNERS; ++k) load_vertex(positions, vertex_of(triangles, i, k), &corners[k]);
}

INLINE void load_element_in(global const float* positions, global const uint* triangles, uint i, const Space* space,
                            Vector* corners) {
    load_element(positions, triangles, i, corners);
    for (int k = 0; k < CORNERS; ++k) {
        // Component by component: a copy of the whole struct out of the array gives garbage boxes on Mesa's OpenCL.
        const Vector p = {corners[k].x, corners[k].y, corners[k].z};
        to_space(space, &p, &corners[k]);
    }
}

INLINE float weigh_element(const Vector* corners, Vector* centroid) {
    *centroid = corners[0];
#if CORNERS == 3
    const Vector *a = &corners[0], *b = &corners[1], *c = &corners[2];
    const Vector u = {b->x - a->x, b->y - a->y, b->z - a->z}, v = {c->x - a->x, c->y - a->y, c->z - a->z};
    Vector normal;
    cross3(&u, &v, &normal);
    add_scaled3(1.0f / 3.0f, &u, centroid);
    add_scaled3(1.0f / 3.0f, &v, centroid);
    return fma(0.5f, sqrt(dot3(&normal, &normal)), 0x1p-40f);
#else
    return 1.0f;
#endif
}

INLINE void store_slabs(const Slabs* slabs, global Aabb* target) {
    global float* floats = (global float*)target;
    vstore4((float4)(slabs->low.x, slabs->low.y, slabs->low.z, slabs->high.x), 0, floats);
    vstore2((float2)(slabs->high.y, slabs->high.z), 2, floats);
}

INLINE void load_slabs(global const Aabb* source, Slabs* slabs) {
    global const float* floats = (global const float*)source;
    const float4 a = vload4(0, floats);
    const float2 b = vload2(2, floats);
    const Vector low = {a.x, a.y, a.z}, high = {a.w, b.x, b.y};
    slabs->low = low;
    slabs->high = high;
}

/// Half the surface area of a box by its ends: unlike the volume it tells flat boxes apart.
INLINE float half_area(const Slabs* ends) {
    const float x = ends->high.x - ends->low.x, y = ends->high.y - ends->low.y, z = ends->high.z - ends->low.z;
    return fma(x, y, fma(y, z, z * x));
}

/// v^T m v
INLINE float along(const Symmetric* m, const Vector* v) {
    const Vector image = {fma(m->xx, v->x, fma(m->xy, v->y, m->xz * v->z)),
                          fma(m->xy, v->x, fma(m->yy, v->y, m->yz * v->z)),
                          fma(m->xz, v->x, fma(m->yz, v->y, m->zz * v->z))};
    return dot3(v, &image);
}

#endif
