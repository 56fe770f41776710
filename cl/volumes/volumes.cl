// SPDX-License-Identifier: MIT
// Axis-aligned boxes of all nodes, bottom-up (dissertation 3.3.4).
// compile:
#include "runtime/numerics.h"
#include "bounds/box.h"

typedef struct Volumes {
    global const Aabb* boxes;
    global const uint* order;
    global Aabb* volumes;
} Volumes;

#define CLIMB_DATA const Volumes*

inline void visit_leaf(const Volumes* v, uint position, uint count) {
    store_box(load_box(v->boxes + v->order[position]), v->volumes + count + position);
}

inline void visit_node(const Volumes* v, uint node, uint2 children, uint count) {
    (void)count;
    store_box(hull(load_box(v->volumes + children.x), load_box(v->volumes + children.y)), v->volumes + node);
}

#include "volumes/climb.h"

/// Boxes of the nodes of one slice of positions.
/// Before: arrivals are 0. After all work-items: volumes[node] for every node of every tree.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void aabb_volumes(global const Aabb* boxes, global const uint* order, global const uint2* children,
                  global const uint* parents, global const uint* far_ends, global handoff_t* arrivals,
                  global Aabb* volumes, uint count, uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    if (begin >= count) return;
    const Climb climb = {children, parents, far_ends, arrivals, count};
    const Volumes data = {boxes, order, volumes};
    climb_slice(&climb, &data, begin, min(begin + slice, count));
}

/// The unused slot at the end of each tree gets the empty box, so that the array has no undefined part.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void empty_unused(global const uint* offsets, global Aabb* volumes, uint trees) {
    const uint tree = (uint)get_global_id(0);
    if (tree >= trees) return;
    Aabb empty;
    for (int k = 0; k < 3; ++k) {
        empty.min[k] = INFINITY;
        empty.max[k] = -INFINITY;
    }
    volumes[offsets[tree + 1] - 1] = empty;
}
