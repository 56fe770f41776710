// SPDX-License-Identifier: MIT
// Depth of binary trees, bottom-up; it determines the size of the traversal stack.
// compile:
#include "shared/types.h"

#define CLIMB_DATA global uint*

inline void visit_leaf(global uint* heights, uint position, uint count) {
    (void)heights;
    (void)position;
    (void)count;
}

inline uint height_of(global const uint* heights, uint node, uint count) { return node >= count ? 0 : heights[node]; }

/// Inner nodes on the longest way from here to a leaf, this one included.
inline void visit_node(global uint* heights, uint node, uint2 children, uint count) {
    heights[node] = 1 + max(height_of(heights, children.x, count), height_of(heights, children.y, count));
}

#include "volumes/climb.h"

/// heights[node] for the inner nodes of one slice of positions; unused slots keep what they had. Before:
/// arrivals are 0.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void node_heights(global const uint2* children, global const uint* parents, global const uint* far_ends,
                  global handoff_t* arrivals, global uint* heights, uint count, uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    if (begin >= count) return;
    const Climb climb = {children, parents, far_ends, arrivals, count};
    climb_slice(&climb, heights, begin, min(begin + slice, count));
}
