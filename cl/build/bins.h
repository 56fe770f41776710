// SPDX-License-Identifier: MIT
// Bins of a node's extent along each axis, with the boxes and counts of the primitives in them. Only minima, maxima and
// counts are used, so the result does not depend on the order of the work.
//
// BINS              most bins along an axis
// BIN_BOX           1: bins of the node's box; 0: of the box of its primitives' centres, fewer for small nodes
// PRIMITIVES_PER_BIN  a small node of n primitives has 4 + n / PRIMITIVES_PER_BIN bins
// Others: build/record.h.
#ifndef BOXWOOD_BUILD_BINS_H
#define BOXWOOD_BUILD_BINS_H
#include "build/record.h"

#if !defined(BINS) || !defined(BIN_BOX) || !defined(PRIMITIVES_PER_BIN)
#error "define BINS, BIN_BOX and PRIMITIVES_PER_BIN"
#endif

/// Bins along each axis of a node. Few primitives need few.
INLINE uint bins_for(uint count) {
#if BIN_BOX
    return BINS;
#else
    return min((uint)BINS, 4 + count / PRIMITIVES_PER_BIN);
#endif
}

/// Where the bins are. Products round alike at every power-of-two scale; an axis without extent has but one bin.
typedef struct Grid {
    float4 low, zoom, scale, last;
} Grid;

INLINE void make_grid(Grid* grid, float8 bounds, float8 centres, uint count) {
    const float8 range = BIN_BOX ? bounds : centres;
    const float4 extent = (float4)(-range.s456 - range.s012, 0.0f);
    const uint bin_count = bins_for(count);
    grid->low = (float4)(range.s012, 0.0f);
    grid->zoom = select((float4)(1.0f), (float4)(0x1p90f), extent < (float4)(0x1p-90f));
    grid->scale = select((float4)(0.0f), (float)bin_count / (extent * grid->zoom), extent > (float4)(0.0f));
    grid->last = (float4)((float)(bin_count - 1));
}

/// The bin along each axis. Clamped before it is an integer: those of centres far outside would be none.
INLINE int4 bin_at(const Grid* grid, float4 centre) {
    const float4 position = (centre - grid->low) * grid->zoom * grid->scale;
    return convert_int4(LESSER(GREATER(position, (float4)(0.0f)), grid->last));
}

/// Lane by lane: bins at or above which primitives go right when the plane is at `bin` of `axis`.
INLINE int4 plane_at(uint axis, uint bin) {
    const int4 lanes = (int4)(0, 1, 2, 3);
    return select((int4)(0x7fffffff), (int4)((int)bin), lanes == (int4)((int)axis));
}

#define SLOTS (3 * BINS)

/// Bin s of axis k at [k * BINS + s].
typedef struct Bins {
    float8 bounds[SLOTS];
    uint counts[SLOTS];
} Bins;

INLINE void clear_bins(Bins* bins, uint bin_count) {
    for (uint k = 0; k < 3; ++k) {
        for (uint s = 0; s < bin_count; ++s) {
            bins->bounds[k * BINS + s] = NO_BOUNDS;
            bins->counts[k * BINS + s] = 0;
        }
    }
}

/// Adds the bins of `other`.
INLINE void join_bins(Bins* bins, const Bins* other, uint bin_count) {
    for (uint k = 0; k < 3; ++k) {
        for (uint s = k * BINS; s < k * BINS + bin_count; ++s) {
            bins->bounds[s] = LESSER(other->bounds[s], bins->bounds[s]);
            bins->counts[s] += other->counts[s];
        }
    }
}

INLINE void add_to_bin(Bins* bins, uint i, float8 record) {
    bins->bounds[i] = LESSER(record, bins->bounds[i]);
    ++bins->counts[i];
}

INLINE void add_to_bins(Bins* bins, int4 bin, float8 record) {
    add_to_bin(bins, (uint)bin.x, record);
    add_to_bin(bins, BINS + (uint)bin.y, record);
    add_to_bin(bins, 2 * BINS + (uint)bin.z, record);
}

/// Adds bounds to those of the left (side 0) or right, both in registers: an array would go through memory.
INLINE void add_to_side(float8* left, float8* right, float8 bounds, uint side) {
    const int8 goes_right = (int8)(side != 0 ? -1 : 0);
    *left = LESSER(select(bounds, NO_BOUNDS, goes_right), *left);
    *right = LESSER(select(NO_BOUNDS, bounds, goes_right), *right);
}

/// The bounds of what lies in the bins of an axis below a plane, and of the others.
INLINE void side_bounds(const Bins* bins, uint axis, uint bin, uint bin_count, float8* left, float8* right) {
    *left = *right = NO_BOUNDS;
    for (uint s = 0; s < bin; ++s) *left = LESSER(bins->bounds[axis * BINS + s], *left);
    for (uint s = bin; s < bin_count; ++s) *right = LESSER(bins->bounds[axis * BINS + s], *right);
}

/// Counts below which one set of bins is as fast as two.
#define FEW_RECORDS 64

/// The bins of the records [begin, end), of at most `bins` bins along each axis. Two sets take turns: a record whose
/// neighbour is in the same bin need not wait for it.
INLINE void bin_records(Bins* bins, const Grid* grid, global const float8* records, global const float* own_centres,
                        uint begin, uint end, uint bin_count) {
    clear_bins(bins, bin_count);
    uint i = begin;
    if (end - begin > FEW_RECORDS) {
        Bins turn;
        clear_bins(&turn, bin_count);
        for (; i + 1 < end; i += 2) {
            const float8 one = records[i], two = records[i + 1];
            const int4 bin_one = bin_at(grid, centre_of(one, own_centres));
            const int4 bin_two = bin_at(grid, centre_of(two, own_centres));
            add_to_bins(bins, bin_one, one);
            add_to_bins(&turn, bin_two, two);
        }
        join_bins(bins, &turn, bin_count);
    }
    for (; i < end; ++i) add_to_bins(bins, bin_at(grid, centre_of(records[i], own_centres)), records[i]);
}

/// Moves the records [begin, end) behind `next_left` or `next_right`, by the side of the plane at `limit` (see
/// plane_at) that they are on, in order. *left and *right become the bounds of their centres.
INLINE void partition_records(const Grid* grid, int4 limit, global const float8* from, global const float* own_centres,
                              uint begin, uint end, global float8* to, uint next_left, uint next_right, float8* left,
                              float8* right) {
    float8 left_centres = NO_BOUNDS, right_centres = NO_BOUNDS;
    for (uint i = begin; i < end; ++i) {
        const float8 record = from[i];
        const float4 centre = centre_of(record, own_centres);
        const uint side = any(bin_at(grid, centre) >= limit) ? 1 : 0;
        to[side == 0 ? next_left : next_right] = record;
        next_left += 1 - side;
        next_right += side;
        add_to_side(&left_centres, &right_centres, point_bounds(centre), side);
    }
    *left = left_centres;
    *right = right_centres;
}

#endif
