// SPDX-License-Identifier: MIT
// compile: SPECULAR=1 UNIFORM_HEMISPHERE=0
// compile: SPECULAR=1 UNIFORM_HEMISPHERE=1
// compile: SPECULAR=0 UNIFORM_HEMISPHERE=0
// compile: SPECULAR=0 UNIFORM_HEMISPHERE=1
#include "render/bsdf.h"

inline void bsdf_of(global const float* material, Bsdf* bsdf) {
    make_bsdf(vload3(0, material), material[3], material[4], material[5], bsdf);
}

/// out[4 i] = value and density for directions[3 i] and `wo`. A material is base colour, metallic, roughness and specular.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) void evaluate_test(global const float* material, float x, float z,
                                                                                  global const float* directions, uint count,
                                                                                  global float* out) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    Bsdf bsdf;
    bsdf_of(material, &bsdf);
    float3 value;
    float pdf;
    evaluate_bsdf(&bsdf, (float3)(x, 0.0f, z), vload3(i, directions), &value, &pdf);
    vstore4((float4)(value, pdf), i, out);
}

/// out[7 i] = direction, value and density drawn with points[3 i].
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) void sample_test(global const float* material, float x, float z,
                                                                                global const float* points, uint count,
                                                                                global float* out) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    Bsdf bsdf;
    bsdf_of(material, &bsdf);
    const float3 wo = (float3)(x, 0.0f, z);
    float3 wi, value;
    float pdf;
    sample_bsdf(&bsdf, wo, points[3 * i], vload2(0, points + 3 * i + 1), &wi);
    evaluate_bsdf(&bsdf, wo, wi, &value, &pdf);
    vstore3(wi, 0, out + 7 * i);
    vstore4((float4)(value, pdf), 0, out + 7 * i + 3);
}
