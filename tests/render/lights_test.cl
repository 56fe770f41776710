// SPDX-License-Identifier: MIT
// compile: LANES=1 TRANSFORMS=1
// compile: LANES=16 TRANSFORMS=1
#define MATERIALS 0
#define NORMALS 0
#define TANGENTS 0
#define UV_SETS 0
#define COLORS 0
#define TEXTURES 0
#define ALPHA 0
#define EMISSION 1
#include "bounds/lanes_of.h"
#include "render/lights.h"

/// For points in space and what chooses light and place (6 components) a LightSample (11) and which light it is of (1),
/// and for the place that a ray from there met (an instance, a primitive, distance and cosine: 4) its density.
/// Component k of record i is at k * count + i, count a multiple of LANES.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void lights_test(global const LightRecord* records, global const LightNode* nodes, uint lights,
                 global const float* points, global const float* places, uint count, global float* samples,
                 global float* densities) {
    const uint at = (uint)get_global_id(0) * LANES;
    if (at >= count) return;
    const LightArrays arrays = {records, light_tree_of(nodes, lights)};
    const SceneArrays scene = {0, 0, 0, 0, 0, 0, 0, 0, 0};
    real p[6], q[4];
    load_components(points, count, at, p, 6);
    const Vector origin = {p[0], p[1], p[2]};
    LightProbabilities probabilities;
    light_probabilities(&arrays.tree, 0.0f, &origin, &probabilities);
    probabilities.distant *= 0.5f;
    probabilities.near *= 0.5f;
    LightSample s;
    sample_light(&scene, &arrays, &probabilities, &origin, 0.5f * p[3], p[4], p[5], &s);
    uint index[LANES];
    real probability, u = 0.5f * p[3];
    choose_any_light(&arrays.tree, &probabilities, &origin, &u, index, &probability);
    const real found[12] = {s.segment.x,   s.segment.y,   s.segment.z,   s.t_max,
                            s.direction.x, s.direction.y, s.direction.z, s.value.x,
                            s.value.y,     s.value.z,     s.pdf,         TO_REAL(LOAD_LANES(index))};
    store_components(found, samples, count, at, 12);
    load_components(places, count, at, q, 4);
    uint instance[LANES], primitive[LANES];
    STORE_LANES(TO_WHOLE(q[0]), instance);
    STORE_LANES(TO_WHOLE(q[1]), primitive);
    const real density[1] = {2.0f * probabilities.near *
                             triangle_pdf(&arrays, &origin, instance, primitive, q[2], q[3])};
    store_components(density, densities, count, at, 1);
}
