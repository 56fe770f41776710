// SPDX-License-Identifier: MIT
// What the kernels of the top-down builder share: how nodes are written, and records put into bins and parted.
//
// OWN_CENTRES  1: primitives go by `centres`, 3 floats each; 0: by the middles of their boxes
#ifndef BOXWOOD_HIERARCHY_TOPDOWN_H
#define BOXWOOD_HIERARCHY_TOPDOWN_H
#include "hierarchy/split.h"

#if !defined(OWN_CENTRES)
#error "define OWN_CENTRES"
#endif

/// As in Topology (include/boxwood/topology.hpp).
typedef struct Nodes {
    global uint* order;
    global uint2* children;
    global uint* parents;
    global uint* far_ends;
    global uint* marks; ///< MARK_..., by inner node
    uint count;         ///< Primitives of the forest.
} Nodes;

/// The index of the inner node over the positions from `first`.
INLINE uint node_index(uint first, uint count, uint flags) { return flags & NODE_LEFT ? first + count - 1 : first; }

/// Writes an inner node and its children's parent.
INLINE void write_node(const Nodes* n, uint first, uint count, uint flags, uint left_count, uint mark) {
    const uint index = node_index(first, count, flags), middle = first + left_count;
    const uint left = left_count == 1 ? n->count + first : middle - 1;
    const uint right = left_count + 1 == count ? n->count + middle : middle;
    n->children[index] = (uint2)(left, right);
    n->far_ends[index] = flags & NODE_LEFT ? first : first + count - 1;
    n->parents[left] = index;
    n->parents[right] = index;
    n->marks[index] = mark;
}

INLINE float4 centre_of(float8 record, global const float* centres) {
#if OWN_CENTRES
    return (float4)(vload3(index_of(record), centres), 0.0f);
#else
    return middle_of(record);
#endif
}

/// Counts below which one set of bins is as fast as two.
#define FEW_RECORDS 64

/// The bins of the records [begin, end), of at most `slices` slices along each axis. Two sets take turns: a record whose
/// neighbour is in the same slice need not wait for it.
INLINE void bin_records(Bins* bins, const Grid* grid, global const float8* records, global const float* own_centres, uint begin,
                        uint end, uint slices) {
    clear_bins(bins, slices);
    uint i = begin;
    if (end - begin > FEW_RECORDS) {
        Bins turn;
        clear_bins(&turn, slices);
        for (; i + 1 < end; i += 2) {
            const float8 one = records[i], two = records[i + 1];
            const int4 place_one = place_in(grid, centre_of(one, own_centres));
            const int4 place_two = place_in(grid, centre_of(two, own_centres));
            add_to_bins(bins, place_one, one);
            add_to_bins(&turn, place_two, two);
        }
        join_bins(bins, &turn, slices);
    }
    for (; i < end; ++i) add_to_bins(bins, place_in(grid, centre_of(records[i], own_centres)), records[i]);
}

/// Moves the records [begin, end) behind `next_left` or `next_right`, by the side of the plane at `limit` (see plane_at) that they
/// are on, in order. *left and *right become the bounds of their centres.
INLINE void part_records(const Grid* grid, int4 limit, global const float8* from, global const float* own_centres, uint begin,
                         uint end, global float8* to, uint next_left, uint next_right, float8* left, float8* right) {
    float8 left_centres = NO_BOUNDS, right_centres = NO_BOUNDS;
    for (uint i = begin; i < end; ++i) {
        const float8 record = from[i];
        const float4 centre = centre_of(record, own_centres);
        const uint side = any(place_in(grid, centre) >= limit) ? 1 : 0;
        to[side == 0 ? next_left : next_right] = record;
        next_left += 1 - side;
        next_right += side;
        add_to_side(&left_centres, &right_centres, point_bounds(centre), side);
    }
    *left = left_centres;
    *right = right_centres;
}

#endif
