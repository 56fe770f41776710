// SPDX-License-Identifier: MIT
// Rays that start where other rays hit: cosine-distributed ones and segments to a light.
//
// GROUP_SIZE  work-items per work-group.
// compile:
#include "render/random.h"
#include "render/surface.h"
#include "render/tangents.h"

#ifndef GROUP_SIZE
#error "define GROUP_SIZE"
#endif

inline Ray make_ray(float3 origin, float3 direction, float t_max) {
    Ray ray;
    vstore3(origin, 0, ray.origin);
    ray.t_min = 0.0f;
    vstore3(direction, 0, ray.direction);
    ray.t_max = t_max;
    return ray;
}

/// A zero direction hits nothing.
inline Ray null_ray(void) { return make_ray((float3)(0.0f), (float3)(0.0f), 0.0f); }

/// `p` on the unit disk lifted to the hemisphere around `n`: density cos / pi (Malley).
inline float3 cosine_direction(float3 n, float2 p) {
    float3 tangent, bitangent;
    tangents_of(n, &tangent, &bitangent);
    const float height = sqrt(1.0f - (p.x * p.x + p.y * p.y));
    return p.x * tangent + p.y * bitangent + height * n;
}

/// out[i] = a ray from the point of hits[i] into a cosine-distributed direction on the side that rays[i] came from, or
/// a null ray for a miss. A work-item makes `length` consecutive rays of the `count`; all ray arrays have `count`
/// elements, the others are those of a Geometry. `out` is neither of the inputs. No barrier: work-items share nothing.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) void
diffuse_rays(global const float* positions, global const uint* triangles, global const MeshRange* meshes,
             global const InstanceRecord* instances, global const Ray* rays, global const Hit* hits, uint count,
             uint length, ulong seed, global Ray* out) {
    const ulong begin = (ulong)get_global_id(0) * length;
    const ulong end = min(begin + length, (ulong)count);
    for (ulong i = begin; i < end; ++i) {
        if (hits[i].primitive == BOXWOOD_NONE) {
            out[i] = null_ray();
            continue;
        }
        const Surface surface = surface_at(positions, triangles, meshes, instances, rays[i], hits[i]);
        const float3 direction = cosine_direction(surface.normal, random_disk(random_key(seed, i)));
        out[i] = make_ray(surface_origin(surface), direction, INFINITY);
    }
}

/// out[i] = the segment from the point of hits[i] to the light, the light itself left out, or a null ray for a miss.
/// As above otherwise.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) void
shadow_rays(global const float* positions, global const uint* triangles, global const MeshRange* meshes,
            global const InstanceRecord* instances, global const Ray* rays, global const Hit* hits, uint count,
            uint length, float light_x, float light_y, float light_z, global Ray* out) {
    const ulong begin = (ulong)get_global_id(0) * length;
    const ulong end = min(begin + length, (ulong)count);
    for (ulong i = begin; i < end; ++i) {
        if (hits[i].primitive == BOXWOOD_NONE) {
            out[i] = null_ray();
            continue;
        }
        const float3 origin = surface_origin(surface_at(positions, triangles, meshes, instances, rays[i], hits[i]));
        // The largest float below 1: t_max is inside the interval.
        out[i] = make_ray(origin, (float3)(light_x, light_y, light_z) - origin, 0x1.fffffep-1f);
    }
}
