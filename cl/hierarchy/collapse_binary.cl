// SPDX-License-Identifier: MIT
// The `binary` layout: each inner node holds the boxes of its two children; leaves are single primitives.
//
// TRIANGLE_LEAVES  1: a leaf names a triangle record by its sorted position; 0: it names the primitive itself
// compile: TRIANGLE_LEAVES=1
// compile: TRIANGLE_LEAVES=0
#include "runtime/numerics.h"
#include "hierarchy/forest.h"
#include "shared/node.h"
#include "shared/triangle.h"

#ifndef TRIANGLE_LEAVES
#error "define TRIANGLE_LEAVES"
#endif

inline Aabb empty_box(void) {
    Aabb box;
    for (int k = 0; k < 3; ++k) {
        box.min[k] = INFINITY;
        box.max[k] = -INFINITY;
    }
    return box;
}

inline uint reference_to(uint child, global const uint* order, uint count) {
    if (child < count) return child;
#if TRIANGLE_LEAVES
    (void)order;
    return BOXWOOD_LEAF | (child - count);
#else
    return BOXWOOD_LEAF | order[child - count];
#endif
}

/// nodes[i] for every slot of every tree. The slot that a tree of one primitive leaves unused becomes its root, with
/// that one leaf; other unused slots become empty nodes.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void binary_nodes(global const Aabb* volumes, global const uint2* children, global const uint* parents,
                  global const uint* order, global BinaryNode* nodes, uint count) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    uint2 below = children[i];
    if (below.x == BOXWOOD_NONE && parents[count + i] == BOXWOOD_NONE) below.x = count + i;
    BinaryNode node;
    node.bounds[0] = below.x == BOXWOOD_NONE ? empty_box() : volumes[below.x];
    node.bounds[1] = below.y == BOXWOOD_NONE ? empty_box() : volumes[below.y];
    node.child[0] = below.x == BOXWOOD_NONE ? BOXWOOD_NONE : reference_to(below.x, order, count);
    node.child[1] = below.y == BOXWOOD_NONE ? BOXWOOD_NONE : reference_to(below.y, order, count);
    node.reserved[0] = node.reserved[1] = 0;
    nodes[i] = node;
}

#if TRIANGLE_LEAVES
/// records[i] = the triangle at sorted position i, its primitive counted from the start of its mesh, for the positions
/// of one slice.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void triangle_records(global const uint* order, global const uint* offsets, global const float* positions,
                      global const uint* triangles, global Triangle* records, uint trees, uint count, uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    if (begin >= count) return;
    const uint end = min(begin + slice, count);
    uint tree = tree_of(offsets, trees, begin);
    for (uint i = begin; i < end; ++i) {
        while (i >= offsets[tree + 1]) ++tree;
        const uint primitive = order[i];
        global const uint* corner = triangles + 3 * (size_t)primitive;
        Triangle record;
        for (int k = 0; k < 3; ++k) {
            const float a = positions[3 * (size_t)corner[0] + k];
            record.v0[k] = a;
            record.edge1[k] = positions[3 * (size_t)corner[1] + k] - a;
            record.edge2[k] = positions[3 * (size_t)corner[2] + k] - a;
        }
        record.primitive = primitive - offsets[tree];
        record.reserved1 = record.reserved2 = 0;
        records[i] = record;
    }
}
#endif
