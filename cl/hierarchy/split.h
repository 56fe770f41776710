// SPDX-License-Identifier: MIT
// How a top-down builder splits one node: slices of its extent along each axis, the boxes and counts of the primitives in them,
// and the best plane between slices. All of it by minima, maxima and counts, so that the order of the work does not show.
//
// BINS                             most slices along an axis
// BIN_BOX                          1: slices of the node's box; 0: of the box of its primitives' centres, fewer for small nodes
// SLICE_PRIMITIVES                 a small node of n primitives has 4 + n / SLICE_PRIMITIVES slices
// COST, AXES, STOP, FALLBACK_MEASURE, FALLBACK_AXES   functions of the strategy
// Others: hierarchy/strategies.h.
#ifndef BOXWOOD_HIERARCHY_SPLIT_H
#define BOXWOOD_HIERARCHY_SPLIT_H
#include "hierarchy/strategies.h"
#include "runtime/inline.h"

#if !defined(BINS) || !defined(BIN_BOX) || !defined(SLICE_PRIMITIVES)
#error "define BINS, BIN_BOX and SLICE_PRIMITIVES"
#endif
#if !defined(COST) || !defined(AXES) || !defined(STOP)
#error "define COST, AXES and STOP"
#endif
#if !defined(FALLBACK_MEASURE) || !defined(FALLBACK_AXES)
#error "define FALLBACK_MEASURE and FALLBACK_AXES"
#endif

// Bounds in a vector: min x, y, z, unused, -max x, y, z, unused. One minimum joins two. A primitive's record is its bounds with
// its index in the first unused lane, as a number that arithmetic takes no detour for.
#define NO_BOUNDS ((float8)(INFINITY))
#define INDEX_MARK 0x40000000u
#define NO_AXIS 3u

INLINE uint index_of(float8 record) { return as_uint(record.s3) & ~INDEX_MARK; }

inline Box box_of(float8 bounds) {
    const Box box = {(float4)(bounds.s012, -bounds.s4), -bounds.s56};
    return box;
}

/// The middle of a record's box; the last lane is 0.
INLINE float4 middle_of(float8 record) {
    const float4 middle = 0.5f * record.s0123 - 0.5f * record.s4567;
    return (float4)(middle.xyz, 0.0f);
}

INLINE float8 point_bounds(float4 point) { return (float8)(point, -point); }

/// Slices along each axis of a node. Few primitives need few.
INLINE uint slices_of(uint count) {
#if BIN_BOX
    return BINS;
#else
    return min((uint)BINS, 4 + count / SLICE_PRIMITIVES);
#endif
}

/// Where the slices are. Products round alike at every power-of-two scale; an axis without extent has but one slice.
typedef struct Grid {
    float4 low, zoom, scale, last;
} Grid;

INLINE void make_grid(Grid* grid, float8 bounds, float8 centres, uint count) {
    const float8 range = BIN_BOX ? bounds : centres;
    const float4 extent = (float4)(-range.s456 - range.s012, 0.0f);
    const uint slices = slices_of(count);
    grid->low = (float4)(range.s012, 0.0f);
    grid->zoom = select((float4)(1.0f), (float4)(0x1p90f), extent < (float4)(0x1p-90f));
    grid->scale = select((float4)(0.0f), (float)slices / (extent * grid->zoom), extent > (float4)(0.0f));
    grid->last = (float4)((float)(slices - 1));
}

/// The slice along each axis. Clamped before it is an integer: those of centres far outside would be none.
INLINE int4 place_in(const Grid* grid, float4 centre) {
    const float4 place = (centre - grid->low) * grid->zoom * grid->scale;
    return convert_int4(LESSER(GREATER(place, (float4)(0.0f)), grid->last));
}

/// Lane by lane: slices at or above which primitives go right when the plane is at `slice` of `axis`.
INLINE int4 plane_at(uint axis, uint slice) {
    const int4 lanes = (int4)(0, 1, 2, 3);
    return select((int4)(0x7fffffff), (int4)((int)slice), lanes == (int4)((int)axis));
}

/// Slice s of axis k at [k * BINS + s].
typedef struct Bins {
    float8 bounds[3 * BINS];
    uint counts[3 * BINS];
} Bins;

INLINE void clear_bins(Bins* bins, uint slices) {
    for (uint k = 0; k < 3; ++k) {
        for (uint s = 0; s < slices; ++s) {
            bins->bounds[k * BINS + s] = NO_BOUNDS;
            bins->counts[k * BINS + s] = 0;
        }
    }
}

/// Adds the bins of `other`.
INLINE void join_bins(Bins* bins, const Bins* other, uint slices) {
    for (uint k = 0; k < 3; ++k) {
        for (uint s = k * BINS; s < k * BINS + slices; ++s) {
            bins->bounds[s] = LESSER(other->bounds[s], bins->bounds[s]);
            bins->counts[s] += other->counts[s];
        }
    }
}

INLINE void add_to_bin(Bins* bins, uint i, float8 record) {
    bins->bounds[i] = LESSER(record, bins->bounds[i]);
    ++bins->counts[i];
}

INLINE void add_to_bins(Bins* bins, int4 place, float8 record) {
    add_to_bin(bins, (uint)place.x, record);
    add_to_bin(bins, BINS + (uint)place.y, record);
    add_to_bin(bins, 2 * BINS + (uint)place.z, record);
}

/// Adds bounds to those of the left (side 0) or right, both in registers: an array would go through memory.
INLINE void add_to_side(float8* left, float8* right, float8 bounds, uint side) {
    const int8 goes_right = (int8)(side != 0 ? -1 : 0);
    *left = LESSER(select(bounds, NO_BOUNDS, goes_right), *left);
    *right = LESSER(select(NO_BOUNDS, bounds, goes_right), *right);
}

/// The bounds of what lies in the slices of an axis below a plane, and of the others.
INLINE void side_bounds(const Bins* bins, uint axis, uint slice, uint slices, float8* left, float8* right) {
    *left = *right = NO_BOUNDS;
    for (uint s = 0; s < slice; ++s) *left = LESSER(bins->bounds[axis * BINS + s], *left);
    for (uint s = slice; s < slices; ++s) *right = LESSER(bins->bounds[axis * BINS + s], *right);
}

/// The best plane so far: primitives in slices below `slice` of `axis` go left.
typedef struct Plane {
    float cost;
    uint larger;   ///< Primitives on the side with more of them; of equal costs the more even split is better.
    float chances; ///< Of both sides, added.
    uint axis;
    uint slice;
    uint left_count;
} Plane;

/// What is asked about a node.
typedef struct Question {
    float8 bounds;
    uint count;
    uint level;
    uint slices;
    float chance;
} Question;

INLINE float chance_of(const Distribution* d, float8 bounds, bool fallback) {
    return fallback ? FALLBACK_MEASURE(d, box_of(bounds)) : MEASURE(d, box_of(bounds));
}

/// Tries all planes between slices of an axis. A plane beside an empty slice parts as the one before does.
INLINE void try_axis(const Distribution* d, const Bins* bins, const Question* q, uint axis, bool fallback, Plane* best) {
    const uint base = axis * BINS;
    float8 rights[BINS];
    float chances[BINS];
    float8 side = NO_BOUNDS;
    float chance = 0.0f;
    for (uint s = q->slices - 1; s > 0; --s) {
        if (bins->counts[base + s] > 0) {
            side = LESSER(bins->bounds[base + s], side);
            chance = chance_of(d, side, fallback);
        }
        rights[s] = side;
        chances[s] = chance;
    }
    side = NO_BOUNDS;
    uint left_count = 0;
    for (uint s = 1; s < q->slices; ++s) {
        const uint added = bins->counts[base + s - 1];
        if (added == 0) continue;
        side = LESSER(bins->bounds[base + s - 1], side);
        left_count += added;
        if (left_count == q->count) return;
        const uint right_count = q->count - left_count;
        const Pair pair = {box_of(q->bounds), box_of(side), box_of(rights[s]), left_count, right_count,
                           q->chance,         chance_of(d, side, fallback), chances[s]};
        const float cost = COST(d, &pair);
        const uint larger = max(left_count, right_count);
        if (cost < best->cost || (cost == best->cost && larger < best->larger)) {
            const Plane plane = {cost, larger, pair.left_chance + pair.right_chance, axis, s, left_count};
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

// What became of a node, in TopDownTree::leaves until they are told apart: MARK_LEAF, and of a split node the axes tried.
#define MARK_LEAF 1u
#define MARK_SPLIT 2u
#define MARK_FALLBACK 4u
#define MARK_TRIED 8u // times the axes

/// The best plane of the fallback: on its best axis that has one. Returns the axes tried.
INLINE uint fall_back(const Distribution* d, const Bins* bins, const Question* q, Plane* best) {
    Question asked = *q;
    asked.chance = chance_of(d, q->bounds, true);
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

/// The paper's figure 9: axes by falling quality until the children are good, else the fallback. A node that no ray meets has no
/// good children. Returns marks; best->axis is NO_AXIS when no plane parts the primitives.
INLINE uint choose_plane(const Distribution* d, const Thresholds* t, const Bins* bins, const Question* q, Plane* best) {
    no_plane(best);
    uint tried = 0;
    bool fallback = q->level >= t->max_non_fallback_levels;
    if (!fallback) {
        float quality[3];
        AXES(d, box_of(q->bounds), q->level, quality);
        for (uint left = 7; left != 0; ++tried) {
            const float ratio = best->axis != NO_AXIS && q->chance > 0.0f ? best->chances / q->chance : INFINITY;
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
    if (q->count <= BLOCK || q->level >= t->max_levels) return true;
    const NodeState state = {box_of(q->bounds), q->count, q->level, q->chance, MEASURE(d, d->root)};
    return STOP(d, t, &state);
}

#endif
