// SPDX-License-Identifier: MIT
// The surface at a hit: point, normal, and how far a new ray must start from it.
#ifndef BOXWOOD_RENDER_SURFACE_H
#define BOXWOOD_RENDER_SURFACE_H
#include "runtime/inline.h"
#include "runtime/numerics.h"
#include "shared/instance.h"
#include "shared/ray.h"

/// A hit point in world space.
typedef struct Surface {
    float3 point;
    float3 normal; ///< Geometric, normalised, on the side that the ray came from. Zero for a triangle without area.
    bool front; ///< The ray met the side from which the vertices go around counter-clockwise, in object space.
    float clearance; ///< Distance along the normal that carries an origin off the triangle (see surface_clearance).
} Surface;

INLINE float3 scaled_by_largest(float3 v) {
    const float largest = fmax(fmax(fabs(v.x), fabs(v.y)), fabs(v.z));
    return largest > 0.0f ? v / largest : v;
}

/// v normalised for any magnitude: squares are taken of numbers with a largest component of 1. Zero stays zero.
INLINE float3 normalize_any(float3 v) {
    const float3 scaled = scaled_by_largest(v);
    const float square = dot(scaled, scaled);
    return square > 0.0f ? scaled / sqrt(square) : scaled;
}

/// rows (3 x 4, affine) applied to a point; with absolute values, to a bound of the magnitudes that meet in it.
INLINE float3 transform_point(global const float* rows, float3 p) {
    return (float3)(dot(vload3(0, rows), p) + rows[3], dot(vload3(0, rows + 4), p) + rows[7],
                    dot(vload3(0, rows + 8), p) + rows[11]);
}

INLINE float3 bound_vector(global const float* rows, float3 magnitude) {
    return (float3)(dot(fabs(vload3(0, rows)), magnitude), dot(fabs(vload3(0, rows + 4)), magnitude),
                    dot(fabs(vload3(0, rows + 8)), magnitude));
}

INLINE float3 bound_point(global const float* rows, float3 magnitude) {
    return bound_vector(rows, magnitude) + fabs((float3)(rows[3], rows[7], rows[11]));
}

/// How far along `normal` the point of a new ray is moved so that a traversal, which sees the triangle through its own
/// roundings, finds it on the right side. With u = 2^-24, `largest` the largest magnitudes of the triangle's vertices
/// in object space, W = |to_world| largest the magnitudes that meet in a world point, and B = |to_world| (|to_object| W)
/// those that meet on the way back to object space, seen from the world, the errors off the plane are at most
///     5 u W    the point from two barycentric products and two sums (edges are at most twice `largest`),
///     4 u W    its transform,  1 u W  the sum with the offset,
///     5 u B    transform of the origin by the rounded inverse,
///     2 u W    its difference to the first vertex,
///     6 u e    the triple product of a well-shaped triangle with edges e, e <= 2 W,
///     8 u W    vertices and edges rounded after flattening,
/// together 32 u W + 5 u B. Slivers pass this: their triple product loses digits in proportion to how thin they are.
/// Scales with the scene.
INLINE float surface_clearance(global const InstanceRecord* instance, float3 largest, float3 normal) {
    const float3 world = bound_point(instance->to_world, largest);
    const float3 back = bound_vector(instance->to_world, bound_point(instance->to_object, world));
    return 0x1p-24f * dot(fabs(normal), 32.0f * world + 5.0f * back);
}

/// The surface that a ray along `direction` met at `hit` (not a miss). `positions`, `triangles`, `meshes` and `instances` are
/// those of a Geometry and `hit` names a triangle and an instance of it.
INLINE void find_surface(global const float* positions, global const uint* triangles, global const MeshRange* meshes,
                         global const InstanceRecord* instances, float3 direction, Hit hit, Surface* surface) {
    global const InstanceRecord* instance = instances + hit.instance;
    const uint3 corner = vload3(meshes[instance->mesh].first_triangle + hit.primitive, triangles);
    const float3 v0 = vload3(corner.x, positions);
    const float3 v1 = vload3(corner.y, positions);
    const float3 v2 = vload3(corner.z, positions);
    const float3 edge1 = v1 - v0;
    const float3 edge2 = v2 - v0;

    // A normal goes to world space by the inverse transpose.
    const float3 n = cross(scaled_by_largest(edge1), scaled_by_largest(edge2));
    global const float* rows = instance->to_object;
    const float3 normal =
        normalize_any(n.x * vload3(0, rows) + n.y * vload3(0, rows + 4) + n.z * vload3(0, rows + 8));
    const float side = dot(normal, direction);

    surface->point = transform_point(instance->to_world, v0 + (hit.u * edge1 + hit.v * edge2));
    surface->normal = side > 0.0f ? -normal : normal;
    surface->front = !(side > 0.0f);
    surface->clearance = surface_clearance(instance, fmax(fmax(fabs(v0), fabs(v1)), fabs(v2)), normal);
}

inline Surface surface_at(global const float* positions, global const uint* triangles, global const MeshRange* meshes,
                          global const InstanceRecord* instances, Ray ray, Hit hit) {
    Surface surface;
    find_surface(positions, triangles, meshes, instances, vload3(0, ray.direction), hit, &surface);
    return surface;
}

/// The origin of a new ray on the normal's side of the surface.
INLINE float3 surface_origin(Surface surface) { return surface.point + surface.clearance * surface.normal; }

#endif
