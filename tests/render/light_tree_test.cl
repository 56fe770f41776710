// SPDX-License-Identifier: MIT
// compile: LANES=1
// compile: LANES=16
#include "bounds/lanes_of.h"
#include "render/light_tree.h"

/// For a place, u, the index of a light that is not distant, and the irradiance of an environment that all have (5
/// components): the light chosen by u from the root of those that are not distant, what is left of u, its probability,
/// that of the light named, and the probabilities of environment, distant and other lights (7). Component k of record i
/// is at k * count + i, count a multiple of LANES.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void light_tree_test(global const LightNode* nodes, uint lights, float environment, global const float* questions,
                     uint count, global float* answers) {
    const uint at = (uint)get_global_id(0) * LANES;
    if (at >= count) return;
    const LightTree tree = light_tree_of(nodes, lights);
    real q[5], probability;
    load_components(questions, count, at, q, 5);
    const Vector place = {q[0], q[1], q[2]};
    uint root[LANES], chosen[LANES], named[LANES];
    for (uint lane = 0; lane < LANES; ++lane) root[lane] = tree.near;
    choose_light(&tree, root, &place, &q[3], chosen, &probability);
    STORE_LANES(TO_WHOLE(q[4]), named);
    LightProbabilities probabilities;
    light_probabilities(&tree, environment, &place, &probabilities);
    const real found[7] = {TO_REAL(LOAD_LANES(chosen)),
                           q[3],
                           probability,
                           near_probability(&tree, named, &place),
                           probabilities.environment,
                           probabilities.distant,
                           probabilities.near};
    store_components(found, answers, count, at, 7);
}
