// SPDX-License-Identifier: MIT
// Hits turned into the planes of a picture, one kernel per kind of plane, so that a plane not asked for costs nothing.
// A work-item writes `length` consecutive pixels of the `count`; every array has `count` elements but those of the
// Geometry. Planes of three components lie one after the other: component c of pixel i at [c * count + i]. No
// barriers: work-items share nothing.
//
// GROUP_SIZE  work-items per work-group.
// compile:
#include "render/surface.h"

#ifndef GROUP_SIZE
#error "define GROUP_SIZE"
#endif

inline void store_planes(float3 value, uint count, ulong i, global float* planes) {
    planes[i] = value.x;
    planes[count + i] = value.y;
    planes[2 * (ulong)count + i] = value.z;
}

/// Linear colour of a ray that meets nothing, brighter upwards. `up` is in [-1, 1].
inline float3 background(float up) {
    return mix((float3)(0.045f, 0.05f, 0.06f), (float3)(0.16f, 0.19f, 0.24f), 0.5f + 0.5f * up);
}

/// Linear colour of a pale matt surface: a light at the eye (`facing` is the cosine towards it), a warm one high on the
/// right that casts no shadow, and a sky, bright and blue from above, dark from below.
inline float3 shade(float3 normal, float facing) {
    const float3 sun_direction = (float3)(0.48f, 0.8f, 0.36f); // normalised
    const float3 sun = fmax(dot(normal, sun_direction), 0.0f) * (float3)(0.50f, 0.46f, 0.40f);
    const float3 sky = mix((float3)(0.03f, 0.03f, 0.03f), (float3)(0.12f, 0.15f, 0.19f), 0.5f + 0.5f * normal.y);
    return sky + sun + 0.16f * facing;
}

/// planes = R, G, B of the shading, linear, in [0, 1].
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) void
film_shading(global const float* positions, global const uint* triangles, global const MeshRange* meshes,
             global const InstanceRecord* instances, global const Ray* rays, global const Hit* hits, uint count,
             uint length, global float* planes) {
    const ulong begin = (ulong)get_global_id(0) * length;
    const ulong end = min(begin + length, (ulong)count);
    for (ulong i = begin; i < end; ++i) {
        const float3 view = normalize_any(vload3(0, rays[i].direction));
        float3 colour = background(view.y);
        if (hits[i].primitive != BOXWOOD_NONE) {
            const float3 normal = surface_at(positions, triangles, meshes, instances, rays[i], hits[i]).normal;
            colour = shade(normal, -dot(normal, view));
        }
        store_planes(colour, count, i, planes);
    }
}

/// planes = x, y, z of the geometric normal in world space, towards the ray's origin; zero for a miss.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) void
film_normals(global const float* positions, global const uint* triangles, global const MeshRange* meshes,
             global const InstanceRecord* instances, global const Ray* rays, global const Hit* hits, uint count,
             uint length, global float* planes) {
    const ulong begin = (ulong)get_global_id(0) * length;
    const ulong end = min(begin + length, (ulong)count);
    for (ulong i = begin; i < end; ++i) {
        float3 normal = (float3)(0.0f);
        if (hits[i].primitive != BOXWOOD_NONE)
            normal = surface_at(positions, triangles, meshes, instances, rays[i], hits[i]).normal;
        store_planes(normal, count, i, planes);
    }
}

/// plane = distance along the ray, whose direction is normalised; infinity for a miss.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) void
film_depth(global const Hit* hits, uint count, uint length, global float* plane) {
    const ulong begin = (ulong)get_global_id(0) * length;
    const ulong end = min(begin + length, (ulong)count);
    for (ulong i = begin; i < end; ++i) plane[i] = hits[i].t;
}

/// The index of the instance and of the triangle in its mesh; BOXWOOD_NONE for a miss.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) void
film_instances(global const Hit* hits, uint count, uint length, global uint* plane) {
    const ulong begin = (ulong)get_global_id(0) * length;
    const ulong end = min(begin + length, (ulong)count);
    for (ulong i = begin; i < end; ++i) plane[i] = hits[i].instance;
}

kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) void
film_primitives(global const Hit* hits, uint count, uint length, global uint* plane) {
    const ulong begin = (ulong)get_global_id(0) * length;
    const ulong end = min(begin + length, (ulong)count);
    for (ulong i = begin; i < end; ++i) plane[i] = hits[i].primitive;
}

/// The volumes and the triangles tested for each ray.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) void
film_costs(global const RayStatistics* statistics, uint count, uint length, global uint* volumes,
           global uint* primitives) {
    const ulong begin = (ulong)get_global_id(0) * length;
    const ulong end = min(begin + length, (ulong)count);
    for (ulong i = begin; i < end; ++i) {
        volumes[i] = statistics[i].volumes;
        primitives[i] = statistics[i].primitives;
    }
}
