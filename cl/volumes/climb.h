// SPDX-License-Identifier: MIT
// The bottom-up walk over a topology (Karras 2012; dissertation 3.3.4): every inner node is visited once, after both
// of its children, in one launch.
//
// A work-item visits the nodes whose range of positions lies inside its slice in plain order; only nodes across slices
// meet through the hand-off.
//
// The includer defines, before the include:
//   CLIMB_DATA                          type of what the visits need
//   visit_leaf(data, position, count)   called once per leaf
//   visit_node(data, node, children, count)  called once per inner node; results of both children are visible
#ifndef BOXWOOD_VOLUMES_CLIMB_H
#define BOXWOOD_VOLUMES_CLIMB_H
#include "runtime/handoff.h"
#include "shared/types.h"

typedef struct Climb {
    global const uint2* children;
    global const uint* parents;
    global const uint* far_ends;
    global handoff_t* arrivals; ///< By split position; 0 before the launch.
    uint count;
} Climb;

/// Goes on from a finished node through the hand-off as far as this work-item is the second to arrive.
inline void climb_across(const Climb* c, CLIMB_DATA data, uint node) {
    for (uint parent = c->parents[node]; parent != BOXWOOD_NONE; parent = c->parents[node]) {
        const uint2 children = c->children[parent];
        const uint position = node >= c->count ? node - c->count : node; // the end of its range beside the split
        const uint split = children.x == node ? position : position - 1;
        if (!handoff_is_second(c->arrivals + split)) return;
        visit_node(data, parent, children, c->count);
        node = parent;
    }
}

/// The leaf at `position` and all that it completes inside the slice. Finished left children wait in position order
/// from `waiting` to here. Returns the new `waiting`.
inline uint climb_leaf(const Climb* c, CLIMB_DATA data, uint position, uint waiting) {
    visit_leaf(data, position, c->count);
    uint node = c->count + position;
    uint first = position;
    while (true) {
        const uint parent = c->parents[node];
        if (parent == BOXWOOD_NONE) return position + 1;
        const uint2 children = c->children[parent];
        if (children.x == node) return waiting;
        if (first == waiting) { // the left sibling lies outside: others may be at work on it
            climb_across(c, data, node);
            return position + 1;
        }
        visit_node(data, parent, children, c->count);
        node = parent;
        first = parent; // of use only if this is a right child or a root, and then it is where its range begins
    }
}

/// Walks the slice [begin, end) of sorted positions.
inline void climb_slice(const Climb* c, CLIMB_DATA data, uint begin, uint end) {
    uint waiting = begin;
    for (uint i = begin; i < end; ++i) waiting = climb_leaf(c, data, i, waiting);
    // What still waits is the left sibling of something beyond the slice.
    for (uint last = end; last > waiting;) {
        const uint position = last - 1;
        const uint leaf = c->count + position;
        const bool is_leaf = c->children[c->parents[leaf]].x == leaf;
        climb_across(c, data, is_leaf ? leaf : position);
        last = is_leaf ? position : c->far_ends[position];
    }
}

#endif
