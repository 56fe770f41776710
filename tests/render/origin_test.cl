// SPDX-License-Identifier: MIT
// Origins of new rays by two methods.
// compile:
#include "render/surface.h"

/// The method of Waechter and Binder 2019: integer steps of the coordinates along the normal, and near the origin a fixed offset.
inline float3 step_origin(float3 point, float3 normal) {
    const int3 steps = convert_int3(256.0f * normal);
    const float3 moved = as_float3(as_int3(point) + select(steps, -steps, point < 0.0f));
    return select(moved, point + normal * (1.0f / 65536.0f), fabs(point) < 1.0f / 32.0f);
}

/// out[i] = the ray from the point of hits[i] along directions[i] or against it, on the side that rays[i] came from; a null ray
/// for a miss. `steps`: 1 for the other method.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) void origin_test(
    global const float* positions, global const uint* triangles, global const MeshRange* meshes,
    global const InstanceRecord* instances, global const Ray* rays, global const Hit* hits, global const float* directions,
    uint count, uint steps, global Ray* out) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    float3 origin = (float3)(0.0f), direction = (float3)(0.0f);
    if (hits[i].primitive != BOXWOOD_NONE) {
        Surface surface;
        find_surface(positions, triangles, meshes, instances, vload3(0, rays[i].direction), hits[i], &surface);
        origin = steps ? step_origin(surface.point, surface.normal) : surface_origin(surface);
        direction = vload3(i, directions);
        direction = dot(direction, surface.normal) < 0.0f ? -direction : direction;
    }
    vstore3(origin, 0, out[i].origin);
    out[i].t_min = 0.0f;
    vstore3(direction, 0, out[i].direction);
    out[i].t_max = INFINITY;
}
