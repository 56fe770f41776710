// SPDX-License-Identifier: MIT
// compile: ENVIRONMENT=1 LANES=1
// compile: ENVIRONMENT=1 LANES=16
// compile: ENVIRONMENT=2 COMPENSATED=0 LANES=1
// compile: ENVIRONMENT=2 COMPENSATED=1 LANES=16
#include "bounds/lanes_of.h"
#include "render/environment.h"

/// For directions (3 components) their radiance and density (4); for points (2) a direction, its density and its
/// radiance (7). Component k of record i is at k * count + i, and count a multiple of LANES. `normal` is +y.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void environment_test(global const EnvironmentRecord* record, global const float* texels, global const float* rows,
                      global const float* columns, global const float* directions, global const float* points,
                      uint count, global float* out, global float* drawn) {
    const uint at = (uint)get_global_id(0) * LANES;
    if (at >= count) return;
#if ENVIRONMENT == 2
    const EnvironmentArrays environment = {record, texels, rows, columns};
#else
    const EnvironmentArrays environment = {record};
#endif
    real d[3], p[2], pdf;
    load_components(directions, count, at, d, 3);
    load_components(points, count, at, p, 2);
    const Vector direction = {d[0], d[1], d[2]};
    Vector sampled, radiance;
    environment_light(&environment, &direction, &radiance, &pdf);
    const real found[4] = {radiance.x, radiance.y, radiance.z, pdf};
    store_components(found, out, count, at, 4);
    const Vector normal = {(real)(0.0f), (real)(1.0f), (real)(0.0f)};
    sample_environment(&environment, &normal, p[0], p[1], &sampled, &radiance, &pdf);
    const real chosen[7] = {sampled.x, sampled.y, sampled.z, pdf, radiance.x, radiance.y, radiance.z};
    store_components(chosen, drawn, count, at, 7);
}
