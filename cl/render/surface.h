// SPDX-License-Identifier: MIT
// The surfaces at hits, one per lane: point, normal, and how far a new ray must start from it.
//
// TRANSFORMS  0: every instance has its mesh where its vertices are; 1: instances have transforms
#ifndef BOXWOOD_RENDER_SURFACE_H
#define BOXWOOD_RENDER_SURFACE_H
#include "runtime/vector.h"
#include "shared/instance.h"
#include "shared/ray.h"

#ifndef TRANSFORMS
#error "define TRANSFORMS (0 or 1)"
#endif

/// Rays, one per lane.
typedef struct Rays {
    Vector origin, direction;
    real t_min, t_max;
} Rays;

/// What rays met, one per lane. Lanes that met nothing name the triangle of one that did, if there is any.
typedef struct Hits {
    real t, u, v;
    mask some; ///< Where there is a hit.
    uint primitive[LANES], instance[LANES];
} Hits;

/// Triangles that were met, one per lane.
typedef struct Triangles {
    uint number[LANES];         ///< In the arrays of all meshes.
    uint corner[3][LANES];      ///< Vertices.
    Vector first, edge1, edge2; ///< Object space.
    Vector largest;             ///< The largest magnitudes of the vertices.
#if TRANSFORMS
    real to_object[12], to_world[12]; ///< Of the instance.
#endif
} Triangles;

/// Hit points in world space, one per lane.
typedef struct Surface {
    Vector point;
    Vector normal;  ///< Geometric, normalised, on the side that the ray came from. Zero for a triangle without area.
    mask front;     ///< The ray met the side from which the vertices go around counter-clockwise, in object space.
    real clearance; ///< Distance along the normal that carries an origin off the triangle (see surface_clearance).
} Surface;

/// The `used` elements from `first` on, one per lane; the lanes behind repeat the last one.
INLINE void lane_indices(uint first, uint used, uint* index) {
    for (uint lane = 0; lane < LANES; ++lane) index[lane] = first + min(lane, used - 1);
}

INLINE void load_rays(global const Ray* from, const uint* index, Rays* rays) {
    real row[8];
    load_rows8(from->origin, 8, index, row);
    const Rays r = {{row[0], row[1], row[2]}, {row[4], row[5], row[6]}, row[3], row[7]};
    *rays = r;
}

/// Lane after lane, for the first `count` lanes.
INLINE void store_rays(const Rays* rays, global Ray* to, const uint* index, uint count) {
    real row[8] = {rays->origin.x,    rays->origin.y,    rays->origin.z,    rays->t_min,
                   rays->direction.x, rays->direction.y, rays->direction.z, rays->t_max};
    store_rows8(row, to->origin, 8, index, count);
}

/// Rays that meet nothing.
INLINE void null_rays(Rays* rays) {
    const real zero = 0.0f;
    const Rays none = {{zero, zero, zero}, {zero, zero, zero}, zero, zero};
    *rays = none;
}

/// The same where `condition` holds. The rays have values before: compilers take a path on which select() is handed
/// what has none for one that is never taken.
INLINE void clear_rays(mask condition, Rays* rays) {
    const real zero = 0.0f;
    const Vector none = {zero, zero, zero};
    choose3(condition, &none, &rays->origin);
    choose3(condition, &none, &rays->direction);
    rays->t_min = CHOOSE(condition, zero, rays->t_min);
    rays->t_max = CHOOSE(condition, zero, rays->t_max);
}

INLINE void load_hits(global const Hit* from, const uint* index, Hits* hits) {
    real row[8];
    load_rows4(&from->t, 5, index, row);
    hits->t = row[0];
    hits->u = row[1];
    hits->v = row[2];
    hits->some = AS_INT(row[3]) != (int)BOXWOOD_NONE;
    for (uint lane = 0; lane < LANES; ++lane) {
        hits->primitive[lane] = from[index[lane]].primitive;
        hits->instance[lane] = from[index[lane]].instance;
    }
    if (!ANY(NOT(hits->some))) return;
    uint stand_in = index[0];
    for (uint lane = 1; lane < LANES && from[stand_in].primitive == BOXWOOD_NONE; ++lane) stand_in = index[lane];
    for (uint lane = 0; lane < LANES; ++lane) {
        if (hits->primitive[lane] != BOXWOOD_NONE) continue;
        hits->primitive[lane] = from[stand_in].primitive;
        hits->instance[lane] = from[stand_in].instance;
    }
}

/// The triangles of `hits`, of which at least one is one. The arrays are those of a Geometry.
INLINE void load_triangles(global const float* positions, global const uint* triangles, global const MeshRange* meshes,
                           global const InstanceRecord* instances, const Hits* hits, Triangles* result) {
    for (uint lane = 0; lane < LANES; ++lane) {
        result->number[lane] = meshes[instances[hits->instance[lane]].mesh].first_triangle + hits->primitive[lane];
        const uint3 corner = vload3(result->number[lane], triangles);
        result->corner[0][lane] = corner.x;
        result->corner[1][lane] = corner.y;
        result->corner[2][lane] = corner.z;
    }
    Vector second, third;
    load_vectors(positions, 3, result->corner[0], &result->first);
    load_vectors(positions, 3, result->corner[1], &second);
    load_vectors(positions, 3, result->corner[2], &third);
    subtract3(&second, &result->first, &result->edge1);
    subtract3(&third, &result->first, &result->edge2);
    result->largest.x = larger(larger(fabs(result->first.x), fabs(second.x)), fabs(third.x));
    result->largest.y = larger(larger(fabs(result->first.y), fabs(second.y)), fabs(third.y));
    result->largest.z = larger(larger(fabs(result->first.z), fabs(second.z)), fabs(third.z));

#if TRANSFORMS
    const uint stride = sizeof(InstanceRecord) / sizeof(float);
    real rows[24];
    load_rows8(instances->to_object, stride, hits->instance, rows);
    load_rows8(instances->to_object + 8, stride, hits->instance, rows + 8);
    load_rows8(instances->to_object + 16, stride, hits->instance, rows + 16);
    for (uint k = 0; k < 12; ++k) {
        result->to_object[k] = rows[k];
        result->to_world[k] = rows[12 + k];
    }
#endif
}

#if TRANSFORMS
/// rows (3 x 4, affine) applied to a vector.
INLINE void rotate_rows(const real* rows, const Vector* v, Vector* result) {
    const Vector r = {fma(rows[0], v->x, fma(rows[1], v->y, rows[2] * v->z)),
                      fma(rows[4], v->x, fma(rows[5], v->y, rows[6] * v->z)),
                      fma(rows[8], v->x, fma(rows[9], v->y, rows[10] * v->z))};
    *result = r;
}

/// The same of magnitudes: bounds of those that meet in it.
INLINE void bound_rows(const real* rows, const Vector* magnitude, Vector* result) {
    const Vector r = {
        fma(fabs(rows[0]), magnitude->x, fma(fabs(rows[1]), magnitude->y, fabs(rows[2]) * magnitude->z)),
        fma(fabs(rows[4]), magnitude->x, fma(fabs(rows[5]), magnitude->y, fabs(rows[6]) * magnitude->z)),
        fma(fabs(rows[8]), magnitude->x, fma(fabs(rows[9]), magnitude->y, fabs(rows[10]) * magnitude->z))};
    *result = r;
}
#endif

INLINE void point_to_world(const Triangles* triangles, const Vector* p, Vector* result) {
#if TRANSFORMS
    const real* rows = triangles->to_world;
    rotate_rows(rows, p, result);
    result->x += rows[3];
    result->y += rows[7];
    result->z += rows[11];
#else
    (void)triangles;
    *result = *p;
#endif
}

INLINE void vector_to_world(const Triangles* triangles, const Vector* v, Vector* result) {
#if TRANSFORMS
    rotate_rows(triangles->to_world, v, result);
#else
    (void)triangles;
    *result = *v;
#endif
}

INLINE void vector_to_object(const Triangles* triangles, const Vector* v, Vector* result) {
#if TRANSFORMS
    rotate_rows(triangles->to_object, v, result);
#else
    (void)triangles;
    *result = *v;
#endif
}

/// By the inverse transpose; of another length.
INLINE void normal_to_world(const Triangles* triangles, const Vector* n, Vector* result) {
#if TRANSFORMS
    const real* rows = triangles->to_object;
    const Vector r = {fma(rows[0], n->x, fma(rows[4], n->y, rows[8] * n->z)),
                      fma(rows[1], n->x, fma(rows[5], n->y, rows[9] * n->z)),
                      fma(rows[2], n->x, fma(rows[6], n->y, rows[10] * n->z))};
    *result = r;
#else
    (void)triangles;
    *result = *n;
#endif
}

/// Bounds of the magnitudes that meet on the way of a vertex to a point in world space, and from there back to object
/// space, as seen from the world.
INLINE void bound_way(const Triangles* triangles, Vector* there, Vector* back) {
#if TRANSFORMS
    const real* to_world = triangles->to_world;
    const real* to_object = triangles->to_object;
    Vector object;
    bound_rows(to_world, &triangles->largest, there);
    there->x += fabs(to_world[3]);
    there->y += fabs(to_world[7]);
    there->z += fabs(to_world[11]);
    bound_rows(to_object, there, &object);
    object.x += fabs(to_object[3]);
    object.y += fabs(to_object[7]);
    object.z += fabs(to_object[11]);
    bound_rows(to_world, &object, back);
#else
    *there = *back = triangles->largest;
#endif
}

/// The longest extent, as a bound on every axis in world space.
INLINE void bound_extent(const Triangles* triangles, Vector* extent) {
    Vector third;
    subtract3(&triangles->edge2, &triangles->edge1, &third);
    const real longest = larger(largest3(&triangles->edge1), larger(largest3(&triangles->edge2), largest3(&third)));
    const Vector isotropic = {longest, longest, longest};
#if TRANSFORMS
    bound_rows(triangles->to_world, &isotropic, extent);
#else
    *extent = isotropic;
#endif
}

/// Normals of the triangles in object space, by the order of the vertices; of another length, zero without area.
INLINE void object_normal(const Triangles* triangles, Vector* normal) {
    Vector edge1 = triangles->edge1, edge2 = triangles->edge2;
    scale_to_one3(&edge1);
    scale_to_one3(&edge2);
    exact_cross3(&edge1, &edge2, normal);
}

/// How far along `normal` the point of a new ray is moved so that a traversal, which sees the triangle through its own
/// roundings, finds it on the right side. With u = 2^-24, W = |to_world| largest the magnitudes that meet in a world
/// point, and B = |to_world| (|to_object| W) those that meet on the way back to object space, seen from the world, the
/// errors off the plane are at most
///     5 u W    the point from two barycentric products and two sums (edges are at most twice `largest`),
///     4 u W    its transform,  1 u W  the sum with the offset,
///     5 u B    transform of the origin by the rounded inverse,
///     8 u W    vertices rounded after flattening,
///    17 u D    the triangle test (traverse/ray_triangle.h), D being the triangle's longest extent, however thin it is.
/// 32 u W + 5 u B + 20 u D are taken, by which the point leaves the padded box of the triangle too
/// (bounds/triangle_box.h: 18 u D and 2 u W), so that a new ray does not test what it has just left. Scales with the
/// scene.
INLINE real surface_clearance(const Triangles* triangles, const Vector* normal) {
    Vector there, back;
    bound_way(triangles, &there, &back);
    scale3((real)(5.0f), &back);
    add_scaled3((real)(32.0f), &there, &back);
    Vector extent;
    bound_extent(triangles, &extent);
    add_scaled3((real)(20.0f), &extent, &back);
    return 0x1p-24f * reach3(normal, &back);
}

/// The surfaces that rays along `direction` met at `hits`.
INLINE void find_surface(const Triangles* triangles, const Vector* direction, const Hits* hits, Surface* surface) {
    Vector object;
    object_normal(triangles, &object);
    normal_to_world(triangles, &object, &surface->normal);
    normalise_any3(&surface->normal);
    surface->clearance = surface_clearance(triangles, &surface->normal);
    const mask back = dot3(&surface->normal, direction) > 0.0f;
    surface->front = NOT(back);
    scale3(CHOOSE(back, (real)(-1.0f), (real)(1.0f)), &surface->normal);

    Vector point = triangles->first;
    add_scaled3(hits->u, &triangles->edge1, &point);
    add_scaled3(hits->v, &triangles->edge2, &point);
    point_to_world(triangles, &point, &surface->point);
}

/// The origins of new rays on the normals' side of the surfaces.
INLINE void surface_origin(const Surface* surface, Vector* origin) {
    *origin = surface->point;
    add_scaled3(surface->clearance, &surface->normal, origin);
}

#endif
