// SPDX-License-Identifier: MIT
// The `binary` layout: each inner node holds the boxes of its two children; leaves are single primitives.
// TRIANGLE_LEAVES: see layout/children.h.
// compile: TRIANGLE_LEAVES=1
// compile: TRIANGLE_LEAVES=0
#include "runtime/numerics.h"
#include "layout/children.h"
#include "shared/node.h"

inline Aabb empty_box(void) {
    Aabb box;
    for (int k = 0; k < 3; ++k) {
        box.min[k] = INFINITY;
        box.max[k] = -INFINITY;
    }
    return box;
}

/// nodes[i] for every slot of every tree; one that nothing refers to is an empty node.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void binary_nodes(global const Aabb* volumes, global const uint2* children, global const uint* parents,
                  global const uint* order, global BinaryNode* nodes, uint count) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const uint2 below = children_of(i, children, parents, count);
    BinaryNode node;
    node.bounds[0] = below.x == BOXWOOD_NONE ? empty_box() : volumes[below.x];
    node.bounds[1] = below.y == BOXWOOD_NONE ? empty_box() : volumes[below.y];
    node.child[0] = below.x == BOXWOOD_NONE ? BOXWOOD_NONE : reference_to(below.x, order, count);
    node.child[1] = below.y == BOXWOOD_NONE ? BOXWOOD_NONE : reference_to(below.y, order, count);
    node.reserved[0] = node.reserved[1] = 0;
    nodes[i] = node;
}
