// SPDX-License-Identifier: MIT
// The oriented box test on arrays of rays and nodes.
// compile: PORTABLE_LANES=1
#include "shared/ray.h"
#include "traverse/ray_obb.h"

/// out[i]: 1 when rays[i] enters the volume of slot i % 2 of nodes[i] in the ray's interval, and entries[i] where, both
/// as traversal has them: with the direction scaled.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void ray_obb_test(global const Ray* rays, global const OrientedNode* nodes, uint count, global uint* out,
                  global float* entries) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const float4 origin = vload4(0, rays[i].origin);
    const float4 direction = vload4(0, rays[i].direction);
    const int exponent = min(exponent_of(largest_of(magnitudes(direction)).x), 126);
    LocalRay ray;
    make_local_ray(origin.xyz, direction.xyz * power_of_two(-exponent), 0, &ray);
    const float t_max = fmin(fmin(direction.w, FLT_MAX) * power_of_two(exponent), FLT_MAX);
    float entry;
    out[i] = ray_obb(&ray, nodes[i].volume[i % 2], origin.w * power_of_two(exponent), t_max, &entry) ? 1 : 0;
    entries[i] = entry * power_of_two(-exponent);
}
