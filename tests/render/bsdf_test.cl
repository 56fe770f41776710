// SPDX-License-Identifier: MIT
// compile: LANES=1 SPECULAR=1 UNIFORM_HEMISPHERE=0
// compile: LANES=8 SPECULAR=1 UNIFORM_HEMISPHERE=0
// compile: LANES=8 SPECULAR=1 UNIFORM_HEMISPHERE=1
// compile: LANES=1 SPECULAR=0 UNIFORM_HEMISPHERE=0
// compile: LANES=8 SPECULAR=0 UNIFORM_HEMISPHERE=0
// compile: LANES=8 SPECULAR=0 UNIFORM_HEMISPHERE=1
#include "bounds/lanes_of.h"
#include "render/bsdf.h"

/// Records: base colour, metallic, roughness, specular, and the x and z of wo, whose y is 0.
INLINE void load_bsdf(global const float* materials, uint count, uint at, Vector* wo, Bsdf* bsdf) {
    real m[8];
    load_components(materials, count, at, m, 8);
    const Vector color = {m[0], m[1], m[2]}, w = {m[6], (real)(0.0f), m[7]};
    *wo = w;
    make_bsdf(&color, m[3], m[4], m[5], wo, bsdf);
}

/// Value and density of each direction.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void evaluate_test(global const float* materials, global const float* directions, global float* results, uint count) {
    const uint at = (uint)get_global_id(0) * LANES;
    if (at >= count) return;
    Bsdf bsdf;
    Vector wo, value;
    load_bsdf(materials, count, at, &wo, &bsdf);
    real d[3], pdf;
    load_components(directions, count, at, d, 3);
    const Vector wi = {d[0], d[1], d[2]};
    evaluate_bsdf(&bsdf, &wo, &wi, &value, &pdf);
    const real values[4] = {value.x, value.y, value.z, pdf};
    store_components(values, results, count, at, 4);
}

/// Direction, value and density drawn with each point.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void sample_test(global const float* materials, global const float* points, global float* results, uint count) {
    const uint at = (uint)get_global_id(0) * LANES;
    if (at >= count) return;
    Bsdf bsdf;
    Vector wo, wi, value;
    load_bsdf(materials, count, at, &wo, &bsdf);
    real p[3], pdf;
    load_components(points, count, at, p, 3);
    sample_bsdf(&bsdf, &wo, p[0], p[1], p[2], &wi);
    evaluate_bsdf(&bsdf, &wo, &wi, &value, &pdf);
    const real values[7] = {wi.x, wi.y, wi.z, value.x, value.y, value.z, pdf};
    store_components(values, results, count, at, 7);
}
