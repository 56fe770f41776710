// SPDX-License-Identifier: MIT
// The contents of the two child slots of a node in the binary layouts.
//
// TRIANGLE_LEAVES  1: a leaf names a triangle record by its sorted position; 0: it names the primitive itself
#ifndef BOXWOOD_LAYOUT_CHILDREN_H
#define BOXWOOD_LAYOUT_CHILDREN_H
#include "shared/aabb.h"

#ifndef TRIANGLE_LEAVES
#error "define TRIANGLE_LEAVES"
#endif

/// The children of inner node `i`. The slot that a tree of one primitive leaves unused becomes its root, with that one
/// leaf; other unused slots have none.
inline uint2 children_of(uint i, global const uint2* children, global const uint* parents, uint count) {
    uint2 below = children[i];
    if (below.x == BOXWOOD_NONE && parents[count + i] == BOXWOOD_NONE) below.x = count + i;
    return below;
}

/// The reference of a child that is not BOXWOOD_NONE.
inline uint reference_to(uint child, global const uint* order, uint count) {
    if (child < count) return child;
#if TRIANGLE_LEAVES
    (void)order;
    return BOXWOOD_LEAF | (child - count);
#else
    return BOXWOOD_LEAF | order[child - count];
#endif
}

#endif
