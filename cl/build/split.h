// SPDX-License-Identifier: MIT
// How a top-down builder splits one node: the best plane between bins of its extent, or none.
//
// COST, AXES, STOP, FALLBACK_MEASURE, FALLBACK_AXES   functions of the strategy
// Others: build/strategies.h, build/bins.h.
#ifndef BOXWOOD_BUILD_SPLIT_H
#define BOXWOOD_BUILD_SPLIT_H
#include "build/bins.h"
#include "build/strategies.h"
#include "build/topdown.h"

#if !defined(COST) || !defined(AXES) || !defined(STOP)
#error "define COST, AXES and STOP"
#endif
#if !defined(FALLBACK_MEASURE) || !defined(FALLBACK_AXES)
#error "define FALLBACK_MEASURE and FALLBACK_AXES"
#endif

#define NO_AXIS 3u

inline Box box_of(float8 bounds) {
    const Box box = {(float4)(bounds.s012, -bounds.s4), -bounds.s56};
    return box;
}

/// The best plane so far: primitives in bins below `bin` of `axis` go left.
typedef struct Plane {
    float cost;
    uint larger;         ///< Primitives on the side with more of them; of equal costs the more even split is better.
    float probabilities; ///< Of both sides, added.
    uint axis;
    uint bin;
    uint left_count;
} Plane;

/// What is asked about a node.
typedef struct Question {
    float8 bounds;
    uint count;
    uint level;
    uint bin_count;
    float probability;
} Question;

INLINE float probability_of(const Distribution* d, float8 bounds, bool fallback) {
    return fallback ? FALLBACK_MEASURE(d, box_of(bounds)) : MEASURE(d, box_of(bounds));
}

/// Tries all planes between bins of an axis. A plane beside an empty bin parts as the one before does.
INLINE void try_axis(const Distribution* d, const Bins* bins, const Question* q, uint axis, bool fallback,
                     Plane* best) {
    const uint base = axis * BINS;
    float8 rights[BINS];
    float probabilities[BINS];
    float8 side = NO_BOUNDS;
    float probability = 0.0f;
    for (uint s = q->bin_count - 1; s > 0; --s) {
        if (bins->counts[base + s] > 0) {
            side = LESSER(bins->bounds[base + s], side);
            probability = probability_of(d, side, fallback);
        }
        rights[s] = side;
        probabilities[s] = probability;
    }
    side = NO_BOUNDS;
    uint left_count = 0;
    for (uint s = 1; s < q->bin_count; ++s) {
        const uint added = bins->counts[base + s - 1];
        if (added == 0) continue;
        side = LESSER(bins->bounds[base + s - 1], side);
        left_count += added;
        if (left_count == q->count) return;
        const uint right_count = q->count - left_count;
        const Pair pair = {box_of(q->bounds),
                           box_of(side),
                           box_of(rights[s]),
                           left_count,
                           right_count,
                           q->probability,
                           probability_of(d, side, fallback),
                           probabilities[s]};
        const float cost = COST(d, &pair);
        const uint larger = max(left_count, right_count);
        if (cost < best->cost || (cost == best->cost && larger < best->larger)) {
            const Plane plane = {cost, larger, pair.left_probability + pair.right_probability, axis, s, left_count};
            *best = plane;
        }
    }
}

INLINE void no_plane(Plane* plane) {
    const Plane none = {INFINITY, 0xffffffffu, INFINITY, NO_AXIS, 0, 0};
    *plane = none;
}

/// The axis of most quality among those in the set `left`; of equal ones the first.
INLINE uint best_axis(const float quality[3], uint left) {
    uint best = NO_AXIS;
    for (uint k = 0; k < 3; ++k)
        if ((left >> k & 1) && (best == NO_AXIS || quality[k] > quality[best])) best = k;
    return best;
}

/// The best plane of the fallback: on its best axis that has one. Returns the axes tried.
INLINE uint fall_back(const Distribution* d, const Bins* bins, const Question* q, Plane* best) {
    Question asked = *q;
    asked.probability = probability_of(d, q->bounds, true);
    float quality[3];
    FALLBACK_AXES(d, box_of(q->bounds), q->level, quality);
    Plane plane;
    no_plane(&plane);
    uint tried = 0;
    for (uint left = 7; left != 0 && plane.axis == NO_AXIS; ++tried) {
        const uint axis = best_axis(quality, left);
        left &= ~(1u << axis);
        try_axis(d, bins, &asked, axis, true, &plane);
    }
    if (plane.axis != NO_AXIS) *best = plane;
    return tried;
}

/// The paper's figure 9: axes by falling quality until the children are good, else the fallback. A node that no ray
/// meets has no good children. Returns marks; best->axis is NO_AXIS when no plane parts the primitives.
INLINE uint choose_plane(const Distribution* d, const Thresholds* t, const Bins* bins, const Question* q, Plane* best) {
    no_plane(best);
    uint tried = 0;
    bool fallback = q->level >= t->max_non_fallback_levels;
    if (!fallback) {
        float quality[3];
        AXES(d, box_of(q->bounds), q->level, quality);
        for (uint left = 7; left != 0; ++tried) {
            const float ratio =
                best->axis != NO_AXIS && q->probability > 0.0f ? best->probabilities / q->probability : INFINITY;
            if (ratio <= t->excellent_children) break;
            const uint axis = best_axis(quality, left);
            left &= ~(1u << axis);
            if (quality[axis] < t->split_plane_quality) {
                fallback = !(ratio < t->acceptable_children);
                break;
            }
            try_axis(d, bins, q, axis, false, best);
        }
        fallback = fallback || best->axis == NO_AXIS;
    }
    if (fallback) tried += fall_back(d, bins, q, best);
    return MARK_SPLIT + (fallback ? MARK_FALLBACK : 0) + tried * MARK_TRIED;
}

/// Whether a node becomes a leaf.
INLINE bool is_leaf(const Distribution* d, const Thresholds* t, const Question* q) {
    if (q->count <= BLOCK_SIZE || q->level >= t->max_levels) return true;
    const NodeState state = {box_of(q->bounds), q->count, q->level, q->probability, MEASURE(d, d->root)};
    return STOP(d, t, &state);
}

#endif
