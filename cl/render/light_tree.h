// SPDX-License-Identifier: MIT
// A binary tree over the lights of a scene, from which one is sampled for a place (Conty Estevez and Kulla 2018): from
// the root down, a child is taken with a probability in proportion to the light that it may send there, regardless of
// occlusion and of the way the surface faces.
#ifndef BOXWOOD_RENDER_LIGHT_TREE_H
#define BOXWOOD_RENDER_LIGHT_TREE_H
#include "runtime/vector.h"
#include "shared/light.h"

/// Lights and the tree over them, see light_tree() of host/render/light_tree.hpp.
typedef struct LightTree {
    global const LightNode* nodes;
    uint inner;         ///< As many nodes of two children, then the leaves in the order of the lights.
    uint distant, near; ///< Roots of the lights that are distant and of the others; BOXWOOD_NONE: there are none.
} LightTree;

/// How the samples of a place are divided; the sum is 1.
typedef struct LightProbabilities {
    real environment, distant, near;
} LightProbabilities;

/// What a node may send to a place: (amplitude^2 facing), irradiance on a surface that faces it.
typedef struct Importance {
    real amplitude; ///< Root of the intensity, over the distance; of distant lights root of the irradiance.
    real facing;    ///< Cosine of the angle to the nearest direction in which it shines.
    mask gives;     ///< Any light at all.
} Importance;

#define LIGHT_NODE_FLOATS 16

// The least of what nodes that shine elsewhere are held to send: as cones are rounded, no light may be left out.
#define LEAST_FACING 0x1p-6f

// The least probability of a node that gives light beside one that does.
#define LEAST_PROBABILITY 0x1p-6f

// What environment, distant and other lights share evenly; the rest goes by irradiance. Walls often keep the brightest
// of them from a place, and no reflected ray finds a light without extent.
#define EVEN_PART 0.5f

/// From its nodes and the number of lights, > 0.
inline LightTree light_tree_of(global const LightNode* nodes, uint lights) {
    LightTree tree = {nodes, lights - 1, BOXWOOD_NONE, BOXWOOD_NONE};
    const uint first = nodes->children[0], second = nodes->children[1]; // of a leaf both itself
    const bool mixed = nodes[first].distant != nodes[second].distant;
    if (nodes[first].distant) tree.distant = mixed ? first : 0;
    if (!nodes[second].distant) tree.near = mixed ? second : 0;
    return tree;
}

/// cos(max(0, a - b)) for angles in [0, pi], by their cosines and sines; `sine`, that of a, becomes that of the result.
INLINE real cosine_beyond(real cosine, real* sine, real other_cosine, real other_sine) {
    const mask within = cosine >= other_cosine;
    const real difference = fma(cosine, other_cosine, *sine * other_sine);
    *sine = CHOOSE(within, (real)(0.0f), fma(*sine, other_cosine, -(cosine * other_sine)));
    return CHOOSE(within, (real)(1.0f), difference);
}

/// Of the nodes that `index` names.
INLINE void importance_of(const LightTree* tree, const uint* index, const Vector* place, Importance* importance) {
    real row[LIGHT_NODE_FLOATS];
    load_rows8(tree->nodes->center, LIGHT_NODE_FLOATS, index, row);
    load_rows8(tree->nodes->center + 8, LIGHT_NODE_FLOATS, index, row + 8);
    const Vector center = {row[0], row[1], row[2]}, axis = {row[4], row[5], row[6]};
    Vector from;
    subtract3(place, &center, &from);
    const real power = power_below(larger(largest3(&from), row[3])), inverse = inverse_power(power);
    const real radius = row[3] * inverse;
    scale3(inverse, &from);
    const real length = sqrt(dot3(&from, &from));
    const mask outside = length > radius;

    // Within its sphere a node shines any way, from as far as the surface.
    const real part = CHOOSE(outside, radius / length, (real)(0.0f));
    real cosine = CHOOSE(outside, dot3(&axis, &from) / length, (real)(1.0f));
    cosine = larger(smaller(cosine, (real)(1.0f)), (real)(-1.0f));
    real sine = sqrt(1.0f - cosine * cosine);
    cosine = cosine_beyond(cosine, &sine, row[8], row[9]);
    cosine = cosine_beyond(cosine, &sine, sqrt(1.0f - part * part), part);

    const mask distant = AS_INT(row[10]) != 0;
    importance->amplitude = CHOOSE(distant, row[7], row[7] * inverse / CHOOSE(outside, length, radius));
    importance->facing = CHOOSE(distant, (real)(1.0f), larger(cosine, (real)(LEAST_FACING)));
    importance->gives = row[7] > 0.0f;
}

INLINE real irradiance_of(const Importance* importance) {
    return importance->amplitude * importance->amplitude * importance->facing;
}

/// Probability of `first` beside `second`; 0 or 1 where one alone gives light, one half where numbers do not tell.
INLINE real first_probability(const Importance* first, const Importance* second) {
    const real ratio = second->amplitude / first->amplitude;
    const real found = 1.0f / (1.0f + ratio * ratio * (second->facing / first->facing));
    const real probability =
        CHOOSE(found >= 0.0f, larger(smaller(found, (real)(1.0f - LEAST_PROBABILITY)), (real)(LEAST_PROBABILITY)),
               (real)(0.5f));
    return CHOOSE(first->gives & NOT(second->gives), (real)(1.0f),
                  CHOOSE(second->gives & NOT(first->gives), (real)(0.0f), probability));
}

/// Importance of the children of nodes. Leaves may be named; what they get is of no use.
INLINE void children_of(const LightTree* tree, const uint* node, const Vector* place, uint* first, uint* second,
                        Importance* of_first, Importance* of_second) {
    for (uint lane = 0; lane < LANES; ++lane) {
        first[lane] = tree->nodes[node[lane]].children[0];
        second[lane] = tree->nodes[node[lane]].children[1];
    }
    importance_of(tree, first, place, of_first);
    importance_of(tree, second, place, of_second);
}

/// node becomes one of its children where it has any; returns where the new one has.
INLINE mask go_down(const LightTree* tree, mask to_first, const uint* first, const uint* second, uint* node) {
    uint next[LANES];
    STORE_LANES(CHOOSE(to_first, LOAD_LANES(first), LOAD_LANES(second)), next);
    for (uint lane = 0; lane < LANES; ++lane) node[lane] = node[lane] < tree->inner ? next[lane] : node[lane];
    return LOAD_LANES(node) < tree->inner;
}

/// Irradiance by all lights that are not distant, of which there are some: by a cut of the tree that is finest about
/// the light that matters most. O(depth of the tree).
INLINE real near_irradiance(const LightTree* tree, const Vector* place) {
    uint node[LANES], first[LANES], second[LANES];
    for (uint lane = 0; lane < LANES; ++lane) node[lane] = tree->near;
    Importance importance, other;
    importance_of(tree, node, place, &importance);
    real sum = 0.0f, last = irradiance_of(&importance);
    for (mask descends = LOAD_LANES(node) < tree->inner; ANY(descends);) {
        children_of(tree, node, place, first, second, &importance, &other);
        const real a = irradiance_of(&importance), b = irradiance_of(&other);
        sum = CHOOSE(descends, sum + smaller(a, b), sum);
        last = CHOOSE(descends, larger(a, b), last);
        descends = go_down(tree, a >= b, first, second, node);
    }
    return sum + last;
}

/// `environment` is its irradiance, 0 where there is none. A single kind has all samples.
INLINE void light_probabilities(const LightTree* tree, float environment, const Vector* place,
                                LightProbabilities* probabilities) {
    const bool sky = environment > 0.0f, distant = tree->distant != BOXWOOD_NONE, near = tree->near != BOXWOOD_NONE;
    const LightProbabilities one = {(real)(sky ? 1.0f : 0.0f), (real)(distant ? 1.0f : 0.0f),
                                    (real)(near ? 1.0f : 0.0f)};
    *probabilities = one;
    const float kinds = (sky ? 1.0f : 0.0f) + (distant ? 1.0f : 0.0f) + (near ? 1.0f : 0.0f);
    if (kinds < 2.0f) return;
    const float from_afar = distant ? tree->nodes[tree->distant].amplitude : 0.0f;
    const real of_distant = from_afar * from_afar;
    real of_near = 0.0f;
    if (near) of_near = near_irradiance(tree, place);
    const real all = environment + of_distant + of_near;
    const mask known = (all > 0.0f) & (all < INFINITY);
    const real even = 1.0f / kinds;
    probabilities->environment *= CHOOSE(known, EVEN_PART * even + (1.0f - EVEN_PART) * (environment / all), even);
    probabilities->distant *= CHOOSE(known, EVEN_PART * even + (1.0f - EVEN_PART) * (of_distant / all), even);
    probabilities->near *= CHOOSE(known, EVEN_PART * even + (1.0f - EVEN_PART) * (of_near / all), even);
}

/// Chooses a light below `root`. `u` in [0, 1) becomes what is left of it, uniform in [0, 1) again. O(depth of the
/// tree). Any place and u, even NaN, give a light.
INLINE void choose_light(const LightTree* tree, const uint* root, const Vector* place, real* u, uint* light,
                         real* probability) {
    uint node[LANES], first[LANES], second[LANES];
    for (uint lane = 0; lane < LANES; ++lane) node[lane] = root[lane];
    *probability = (real)(1.0f);
    for (mask descends = LOAD_LANES(node) < tree->inner; ANY(descends);) {
        Importance importance, other;
        children_of(tree, node, place, first, second, &importance, &other);
        const real of_first = first_probability(&importance, &other);
        const mask is_first = *u < of_first;
        const real chosen = CHOOSE(is_first, of_first, 1.0f - of_first);
        const real rest = smaller(CHOOSE(is_first, *u, *u - of_first) / chosen, (real)(BEFORE_ONE));
        *u = CHOOSE(descends, rest, *u);
        *probability = CHOOSE(descends, *probability * chosen, *probability);
        descends = go_down(tree, is_first, first, second, node);
    }
    for (uint lane = 0; lane < LANES; ++lane) light[lane] = node[lane] - tree->inner;
}

/// With what probability choose_light gives the lights that `light` names, not distant, from the root of those. O(their
/// depth).
INLINE real near_probability(const LightTree* tree, const uint* light, const Vector* place) {
    uint node[LANES], parent[LANES], first[LANES], second[LANES];
    for (uint lane = 0; lane < LANES; ++lane) node[lane] = tree->inner + light[lane];
    real probability = 1.0f;
    for (mask ascends = LOAD_LANES(node) != tree->near; ANY(ascends); ascends = LOAD_LANES(node) != tree->near) {
        for (uint lane = 0; lane < LANES; ++lane)
            parent[lane] = node[lane] == tree->near ? node[lane] : tree->nodes[node[lane]].parent;
        Importance importance, other;
        children_of(tree, parent, place, first, second, &importance, &other);
        const real of_first = first_probability(&importance, &other);
        const real chosen = CHOOSE(LOAD_LANES(first) == LOAD_LANES(node), of_first, 1.0f - of_first);
        probability = CHOOSE(ascends, probability * chosen, probability);
        for (uint lane = 0; lane < LANES; ++lane) node[lane] = parent[lane];
    }
    return probability;
}

#endif
