// SPDX-License-Identifier: MIT
// Rays that start where other rays hit: cosine-distributed ones and segments to a light.
//
// GROUP_SIZE  work-items per work-group.
// LANES       1
// TRANSFORMS  1
// compile: LANES=1 TRANSFORMS=1
#include "render/random.h"
#include "render/surface.h"
#include "render/tangents.h"

#if !defined(GROUP_SIZE) || LANES != 1
#error "define GROUP_SIZE and LANES (1)"
#endif

/// Uniform in (-1, 1), from the top 24 bits: the centres of 2^24 equal parts, exact in float up to the last bit.
INLINE float random_signed(ulong bits) { return (float)((int)(bits >> 40) - 0x800000) * 0x1p-23f + 0x1p-24f; }

/// A point uniform in the open unit disk, by rejection from the square: no trigonometric function, whose last digits
/// differ between devices. A square's point is rejected with probability 1 - pi/4, so that 32 draws fail once in 2^71.
INLINE float2 random_disk(ulong key) {
    for (uint draw = 0; draw < 32; ++draw) {
        const ulong bits = random_bits(key, draw);
        const float2 p = (float2)(random_signed(bits), random_signed(bits << 24));
        if (p.x * p.x + p.y * p.y < 1.0f) return p;
    }
    return (float2)(0.0f, 0.0f);
}

/// `p` on the unit disk lifted to the hemisphere around `n`: density cos / pi (Malley).
INLINE void cosine_direction(const Vector* n, float2 p, Vector* direction) {
    Vector tangent, bitangent;
    tangents_of(n, &tangent, &bitangent);
    *direction = *n;
    scale3(sqrt(1.0f - (p.x * p.x + p.y * p.y)), direction);
    add_scaled3(p.x, &tangent, direction);
    add_scaled3(p.y, &bitangent, direction);
}

/// The surface at hits[i]; false for a miss.
INLINE bool surface_at(global const float* positions, global const uint* triangles, global const MeshRange* meshes,
                       global const InstanceRecord* instances, global const Ray* rays, global const Hit* hits, uint i,
                       Surface* surface) {
    Rays ray;
    Hits hit;
    load_rays(rays, &i, &ray);
    load_hits(hits, &i, &hit);
    if (!hit.some) return false;
    Triangles triangle;
    load_triangles(positions, triangles, meshes, instances, &hit, &triangle);
    find_surface(&triangle, &ray.direction, &hit, surface);
    return true;
}

/// out[i] = a ray from the point of hits[i] into a cosine-distributed direction on the side that rays[i] came from, or
/// a null ray for a miss. A work-item makes `length` consecutive rays of the `count`; all ray arrays have `count`
/// elements, the others are those of a Geometry. `out` is neither of the inputs. No barrier: work-items share nothing.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void diffuse_rays(global const float* positions, global const uint* triangles, global const MeshRange* meshes,
                  global const InstanceRecord* instances, global const Ray* rays, global const Hit* hits, uint count,
                  uint length, ulong seed, global Ray* out) {
    const ulong begin = (ulong)get_global_id(0) * length;
    const ulong end = min(begin + length, (ulong)count);
    for (ulong i = begin; i < end; ++i) {
        const uint index = (uint)i;
        Surface surface;
        Rays ray;
        if (surface_at(positions, triangles, meshes, instances, rays, hits, index, &surface)) {
            surface_origin(&surface, &ray.origin);
            cosine_direction(&surface.normal, random_disk(random_key(seed, index)), &ray.direction);
            ray.t_min = 0.0f;
            ray.t_max = INFINITY;
        } else {
            null_rays(&ray);
        }
        store_rays(&ray, out, &index, 1);
    }
}

/// out[i] = the segment from the point of hits[i] to the light, the light itself left out, or a null ray for a miss.
/// As above otherwise.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void shadow_rays(global const float* positions, global const uint* triangles, global const MeshRange* meshes,
                 global const InstanceRecord* instances, global const Ray* rays, global const Hit* hits, uint count,
                 uint length, float light_x, float light_y, float light_z, global Ray* out) {
    const ulong begin = (ulong)get_global_id(0) * length;
    const ulong end = min(begin + length, (ulong)count);
    for (ulong i = begin; i < end; ++i) {
        const uint index = (uint)i;
        Surface surface;
        Rays ray;
        if (surface_at(positions, triangles, meshes, instances, rays, hits, index, &surface)) {
            const Vector light = {light_x, light_y, light_z};
            surface_origin(&surface, &ray.origin);
            subtract3(&light, &ray.origin, &ray.direction);
            ray.t_min = 0.0f;
            ray.t_max = BEFORE_ONE;
        } else {
            null_rays(&ray);
        }
        store_rays(&ray, out, &index, 1);
    }
}
