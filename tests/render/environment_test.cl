// SPDX-License-Identifier: MIT
// compile: ENVIRONMENT=1
// compile: ENVIRONMENT=2
#include "render/environment.h"

/// For each direction its radiance and density, out[4 i]; for each point a direction, its density and its radiance, drawn[7 i].
/// `normal` is +y.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) void environment_test(
    global const EnvironmentRecord* record, global const float* texels, global const float* rows, global const float* columns,
    global const float* directions, global const float* points, uint count, global float* out, global float* drawn) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
#if ENVIRONMENT == 2
    const EnvironmentArrays environment = {record, texels, rows, columns};
#else
    const EnvironmentArrays environment = {record};
#endif
    const float3 direction = vload3(i, directions);
    float3 sampled;
    float pdf;
    const float3 radiance = environment_light(&environment, direction, &pdf);
    vstore4((float4)(radiance, pdf), i, out);
    const float3 light = sample_environment(&environment, (float3)(0.0f, 1.0f, 0.0f), vload2(i, points), &sampled, &pdf);
    vstore4((float4)(sampled, pdf), 0, drawn + 7 * i);
    vstore3(light, 0, drawn + 7 * i + 4);
}
