// SPDX-License-Identifier: MIT
// What a top-down builder asks of a strategy, and the strategies there are (paper sections 7 and 8.1,
// thesis 4 and 5.1).
//
//   measure  float NAME(const Distribution* d, Box box)
//            probability that a ray meets the box
//   cost     float NAME(const Distribution* d, const Pair* pair)
//            of two children; the least wins
//   axes     void NAME(const Distribution* d, Box node, uint level, float quality[3])
//            of planes across an axis: [0, 1]
//   stop     bool NAME(const Distribution* d, const Thresholds* t, const NodeState* s)
//            whether a node is a leaf
//
// MEASURE  the strategy's measure
// BLOCK_SIZE    primitives that a leaf tests at once
#ifndef BOXWOOD_BUILD_STRATEGIES_H
#define BOXWOOD_BUILD_STRATEGIES_H
#include "influence/distribution.h"
#include "shared/topdown.h"

#if !defined(MEASURE) || !defined(BLOCK_SIZE)
#error "define MEASURE and BLOCK_SIZE"
#endif

/// Two children that a node may get.
typedef struct Pair {
    Box node, left, right;
    uint left_count, right_count;
    float node_probability, left_probability, right_probability;
} Pair;

/// A node before it is split.
typedef struct NodeState {
    Box node;
    uint count;
    uint level;             ///< The root's is 0.
    float probability;      ///< By the measure.
    float root_probability; ///< That of the whole tree.
} NodeState;

/// Testing a leaf costs the same however full it is, so in nodes of few leaves the primitives count as the leaves that
/// hold them. In larger ones that would keep planes away from where boxes are smallest.
inline float rounded_count(uint count) {
    return (float)(count <= 4 * BLOCK_SIZE ? (count + BLOCK_SIZE - 1) / BLOCK_SIZE * BLOCK_SIZE : count);
}

/// What the primitives on both sides cost.
inline float measured_cost(const Distribution* d, const Pair* pair) {
    (void)d;
    return pair->left_probability * rounded_count(pair->left_count) +
           pair->right_probability * rounded_count(pair->right_count);
}

/// Planes across the longer extents are the better ones; a point has no better axis.
inline void longest_axes(const Distribution* d, Box node, uint level, float quality[3]) {
    (void)d;
    (void)level;
    const float3 extent = extent_of(node);
    const float longest = max(max(extent.x, extent.y), extent.z);
    quality[0] = longest > 0.0f ? extent.x / longest : 1.0f;
    quality[1] = longest > 0.0f ? extent.y / longest : 1.0f;
    quality[2] = longest > 0.0f ? extent.z / longest : 1.0f;
}

/// Planes that the rays see edge-on, whose two sides overlap least in what rays see: the splitting plane facing
/// heuristic. The ray of a point area is the one through the middle of the node. Without areas all axes are as good.
/// The quality is the square of 1 less the share of the axis in the ray's direction: the paper gives the share only,
/// and with the square its thresholds give the numbers of axes tried and of fallbacks of its table 2.
inline void facing_axes(const Distribution* d, Box node, uint level, float quality[3]) {
    (void)level;
    float facing[3] = {0.0f, 0.0f, 0.0f}, shares = 0.0f;
    for (uint i = 0; i < d->area_count; ++i) {
        global const InfluenceRecord* area = d->areas + i;
        float v[3] = {fabs(area->forward[0]), fabs(area->forward[1]), fabs(area->forward[2])};
        if (area->point) {
            v[0] = fabs(0.5f * node.a.x + 0.5f * node.a.w - area->origin[0]);
            v[1] = fabs(0.5f * node.a.y + 0.5f * node.b.x - area->origin[1]);
            v[2] = fabs(0.5f * node.a.z + 0.5f * node.b.y - area->origin[2]);
        }
        const float largest = max(max(v[0], v[1]), v[2]);
        if (!(largest > 0.0f)) continue; // the eye is the middle
        const float sum = v[0] / largest + v[1] / largest + v[2] / largest;
        for (int k = 0; k < 3; ++k) facing[k] += area->share * (v[k] / largest / sum);
        shares += area->share;
    }
    for (int k = 0; k < 3; ++k) {
        const float across = shares > 0.0f ? 1.0f - facing[k] / shares : 1.0f;
        quality[k] = across * across;
    }
}

inline void round_robin_axes(const Distribution* d, Box node, uint level, float quality[3]) {
    (void)d;
    (void)node;
    for (uint k = 0; k < 3; ++k) quality[k] = k == level % 3 ? 1.0f : 0.0f;
}

inline void all_axes(const Distribution* d, Box node, uint level, float quality[3]) {
    (void)d;
    (void)node;
    (void)level;
    for (int k = 0; k < 3; ++k) quality[k] = 1.0f;
}

/// The paper's 8.1.7.
inline bool threshold_stop(const Distribution* d, const Thresholds* t, const NodeState* s) {
    (void)d;
    return s->count <= t->max_leaf_primitives || s->probability * (float)s->count < t->max_leaf_cost ||
           s->probability < t->max_leaf_area * s->root_probability || s->probability < t->max_leaf_hit_probability;
}

inline bool never(const Distribution* d, const Thresholds* t, const NodeState* s) {
    (void)d;
    (void)t;
    (void)s;
    return false;
}

// The caller's own functions; they may use all of the above.
#include "runtime/inserted.h"

/// measured_cost, and a quarter of what testing the smaller child's primitives costs the rays that meet the box which
/// both children share: of planes that cost the same the one whose sides overlap less is better, as hits there leave no
/// box to be skipped.
inline float overlap_cost(const Distribution* d, const Pair* pair) {
    const float cost = measured_cost(d, pair);
    const Box shared = {(float4)(GREATER(pair->left.a.xyz, pair->right.a.xyz), fmin(pair->left.a.w, pair->right.a.w)),
                        LESSER(pair->left.b, pair->right.b)};
    const float3 extent = extent_of(shared);
    if (!(extent.x >= 0.0f && extent.y >= 0.0f && extent.z >= 0.0f)) return cost;
    return cost + 0.25f * MEASURE(d, shared) * (float)min(pair->left_count, pair->right_count);
}

#endif
