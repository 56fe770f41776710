// SPDX-License-Identifier: MIT
// Hierarchy of linear BVHs from the gaps between sorted primitives: Karras's radix tree ("Maximizing parallelism in the
// construction of BVHs, octrees, and k-d trees", 2012; dissertation 3.3.3), found bottom-up as by Apetrei ("Fast and
// simple agglomerative LBVH construction", 2014): a range of positions knows its parent from the gaps at its two ends
// alone.
//
// A work-item merges all nodes whose range lies inside its slice in plain order; only nodes across slices meet through
// the hand-off. So one launch serves a CPU with a few long slices and a GPU with many short ones.
//
// compile:
#include "build/gaps.h"
#include "runtime/handoff.h"
#include "shared/types.h"

typedef struct Trees {
    global const gap_t* gaps;
    global uint2* children;
    global uint* parents;
    global uint* far_ends;
    global uint* outer_ends;    ///< [2 p], [2 p + 1]: first position left, last position right of the split after p
    global handoff_t* arrivals; ///< By split position: children that reached it through the hand-off
    uint count;
} Trees;

/// Positions [first, last] of a node whose children are parted after `split`; a leaf has first == last.
typedef struct Range {
    uint first;
    uint last;
    uint split;
} Range;

/// The gap after position i, NO_GAP also for i = -1. The gaps at both ends of a node never tie, but for a root's.
inline uint gap_after(const Trees* f, uint i) { return i + 1 == 0 ? NO_GAP : f->gaps[i]; }

/// Writes the node, now that its side and so its index are known.
inline void write_node(const Trees* f, Range node, bool left) {
    if (node.first == node.last) return;
    const uint index = left ? node.last : node.first;
    const uint child0 = node.split == node.first ? f->count + node.split : node.split;
    const uint child1 = node.split + 1 == node.last ? f->count + node.last : node.split + 1;
    f->children[index] = (uint2)(child0, child1);
    f->far_ends[index] = left ? node.first : node.last;
    f->parents[child0] = index;
    f->parents[child1] = index;
}

/// Closes a tree: its root, and the slot that its inner nodes leave unused.
inline void write_root(const Trees* f, Range node) {
    write_node(f, node, false);
    f->parents[node.first == node.last ? f->count + node.first : node.first] = BOXWOOD_NONE;
    f->children[node.last] = (uint2)(BOXWOOD_NONE, BOXWOOD_NONE);
    f->far_ends[node.last] = node.last;
    f->parents[node.last] = BOXWOOD_NONE;
}

/// Climbs from a finished node through the hand-off as far as this work-item is the second to arrive.
inline void climb(const Trees* f, Range node) {
    while (true) {
        const uint gap_left = gap_after(f, node.first - 1), gap_right = gap_after(f, node.last);
        if (gap_left == gap_right) break; // both NO_GAP
        const bool left = gap_right < gap_left;
        write_node(f, node, left);
        const uint split = left ? node.last : node.first - 1;
        f->outer_ends[2 * split + (left ? 0 : 1)] = left ? node.first : node.last;
        if (!handoff_is_second(f->arrivals + split)) return;
        if (left)
            node.last = f->outer_ends[2 * split + 1];
        else
            node.first = f->outer_ends[2 * split];
        node.split = split;
    }
    write_root(f, node);
}

/// Nodes of one slice of sorted positions.
/// Before: gaps[] are those after every position, arrivals are 0. After all work-items: children, parents and far_ends
/// of every node are written.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void lbvh(global const gap_t* gaps, global uint2* children, global uint* parents, global uint* far_ends,
          global uint* outer_ends, global handoff_t* arrivals, uint count, uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    if (begin >= count) return;
    const uint end = min(begin + slice, count);
    const Trees all = {gaps, children, parents, far_ends, outer_ends, arrivals, count};
    const Trees* f = &all;

    // Finished left children wait in position order: one ends where the next begins, from `waiting` up to the
    // current node. outer_ends[2 * last] holds where each begins.
    uint waiting = begin;
    for (uint i = begin; i < end; ++i) {
        const uint gap_right = gap_after(f, i);
        Range node = {i, i, i};
        while (true) {
            const uint gap_left = gap_after(f, node.first - 1);
            if (gap_right < gap_left) {
                write_node(f, node, true);
                outer_ends[2 * i] = node.first;
                break;
            }
            // A root, or a right child whose left sibling lies outside, where others may be at work on it.
            if (gap_right == gap_left || node.first == waiting) {
                climb(f, node);
                waiting = i + 1;
                break;
            }
            write_node(f, node, false);
            node.split = node.first - 1;
            node.first = outer_ends[2 * node.split];
        }
    }
    // What still waits is the left sibling of something beyond the slice.
    for (uint last = end; last > waiting;) {
        const uint first = outer_ends[2 * (last - 1)];
        if (!handoff_is_second(arrivals + last - 1)) {
            last = first;
            continue;
        }
        const Range parent = {first, outer_ends[2 * (last - 1) + 1], last - 1};
        climb(f, parent);
        last = first;
    }
}
