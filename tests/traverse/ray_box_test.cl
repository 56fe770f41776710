// SPDX-License-Identifier: MIT
// The box tests on arrays of rays and boxes. Macros: PORTABLE_LANES.
// compile: PORTABLE_LANES=0
// compile: PORTABLE_LANES=1
#include "shared/ray.h"
#include "traverse/ray_box.h"

/// out[i]: 1 when rays[i] enters boxes[i], and entries[i] where; both for the interval of the ray.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void ray_box_test(global const Ray* rays, global const Aabb* boxes, uint count, global uint* out,
                  global float* entries) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const float4 origin = vload4(0, rays[i].origin);
    const float4 direction = vload4(0, rays[i].direction);
    LocalRay ray;
    make_local_ray(origin.xyz, direction.xyz, 0, &ray);
    float entry;
    out[i] = ray_box(&ray, &boxes[i], origin.w, fmin(direction.w, FLT_MAX), &entry) ? 1 : 0;
    entries[i] = entry;
}

/// out[i]: the lanes of nodes[i] that rays[i] enters, and entries[8 * i + lane] where.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void ray_box8_test(global const Ray* rays, global const Wide8Node* nodes, uint count, global uint* out,
                   global float* entries) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const float4 origin = vload4(0, rays[i].origin);
    const float4 direction = vload4(0, rays[i].direction);
    LocalRay ray;
    make_local_ray(origin.xyz, direction.xyz, 0, &ray);
    float8 entry;
    out[i] = ray_box8(&ray, &nodes[i], origin.w, fmin(direction.w, FLT_MAX), &entry);
    vstore8(entry, i, entries);
}
