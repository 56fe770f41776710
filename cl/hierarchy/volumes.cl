// SPDX-License-Identifier: MIT
// Axis-aligned boxes of all nodes, bottom-up (dissertation 3.3.4).
// compile:
#include "runtime/numerics.h"
#include "shared/aabb.h"

typedef struct Volumes {
    global const Aabb* boxes;
    global const uint* order;
    global Aabb* volumes;
} Volumes;

#define CLIMB_DATA const Volumes*

inline void visit_leaf(const Volumes* v, uint position, uint count) {
    v->volumes[count + position] = v->boxes[v->order[position]];
}

/// Hull of the two children; exact, since min and max do not round.
inline void visit_node(const Volumes* v, uint node, uint2 children, uint count) {
    (void)count;
    const Aabb a = v->volumes[children.x];
    const Aabb b = v->volumes[children.y];
    Aabb hull;
    for (int k = 0; k < 3; ++k) {
        hull.min[k] = a.min[k] < b.min[k] ? a.min[k] : b.min[k];
        hull.max[k] = a.max[k] > b.max[k] ? a.max[k] : b.max[k];
    }
    v->volumes[node] = hull;
}

#include "hierarchy/climb.h"

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
