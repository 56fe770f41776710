// SPDX-License-Identifier: MIT
// Origins of new rays by two methods.
// compile: LANES=1 TRANSFORMS=1
#include "render/surface.h"

/// The method of Waechter and Binder 2019: integer steps of the coordinates along the normal, and near the origin a
/// fixed offset.
inline float3 step_origin(float3 point, float3 normal) {
    const int3 steps = convert_int3(256.0f * normal);
    const float3 moved = as_float3(as_int3(point) + select(steps, -steps, point < 0.0f));
    return select(moved, point + normal * (1.0f / 65536.0f), fabs(point) < 1.0f / 32.0f);
}

/// out[i] = the ray from the point of hits[i] along directions[i] or against it, on the side that rays[i] came from; a
/// null ray for a miss. `steps`: 1 for the other method.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void origin_test(global const float* positions, global const uint* triangles, global const MeshRange* meshes,
                 global const InstanceRecord* instances, global const Ray* rays, global const Hit* hits,
                 global const float* directions, uint count, uint steps, global Ray* out) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    Rays ray;
    Hits hit;
    load_rays(rays, &i, &ray);
    load_hits(hits, &i, &hit);
    if (hit.some) {
        Triangles triangle;
        Surface surface;
        load_triangles(positions, triangles, meshes, instances, &hit, &triangle);
        find_surface(&triangle, &ray.direction, &hit, &surface);
        surface_origin(&surface, &ray.origin);
        if (steps) {
            const float3 point = (float3)(surface.point.x, surface.point.y, surface.point.z);
            spread3(step_origin(point, (float3)(surface.normal.x, surface.normal.y, surface.normal.z)), &ray.origin);
        }
        spread3(vload3(i, directions), &ray.direction);
        scale3(dot3(&ray.direction, &surface.normal) < 0.0f ? -1.0f : 1.0f, &ray.direction);
        ray.t_min = 0.0f;
        ray.t_max = INFINITY;
    } else {
        null_rays(&ray);
    }
    store_rays(&ray, out, &i, 1);
}
