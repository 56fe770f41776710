// SPDX-License-Identifier: MIT
// What it costs to cover a subtree by wide nodes: the dynamic program of Ylitie, Karras and Laine ("Efficient
// incoherent ray traversal on GPUs through compressed wide BVHs", 2017, section 3.1), bottom-up.
//
// costs[8 n + i - 1], i = 1..7: least cost of the subtree of inner node n when it may hang from its wide parent as up to
// i boxes; costs[8 n + 7]: least cost below n when n itself is a wide node, shared out over up to 8 boxes. All are
// expected costs per ray that hits n's box, so they are free of scale and neither overflow nor vanish.
//
// LEAF_SIZE  most primitives in a leaf
// NODE_COST  cost of testing one wide node (float)
// LEAF_COST  cost of testing one leaf (float)
// compile: LEAF_SIZE=4 NODE_COST=1.0f LEAF_COST=1.0f
#include "runtime/numerics.h"
#include "hierarchy/collapse_cost.h"

typedef struct Costs {
    global const Aabb* volumes;
    global const uint* far_ends;
    global float* costs;
} Costs;

#define CLIMB_DATA const Costs*

inline void visit_leaf(const Costs* c, uint position, uint count) {
    (void)c;
    (void)position;
    (void)count;
}

/// cost[1..7] of a child, weighted by the chance that a ray that hits the parent hits it.
inline void child_costs(const Costs* c, uint child, float weight, uint count, float* out) {
    for (int i = 0; i < 7; ++i) out[i] = weight * (child >= count ? LEAF_COST : c->costs[8 * (size_t)child + i]);
}

inline void visit_node(const Costs* c, uint node, uint2 children, uint count) {
    const float2 weight = hit_chances(c->volumes + node, c->volumes + children.x, c->volumes + children.y);
    float a[7], b[7], shared_out[9];
    child_costs(c, children.x, weight.x, count, a);
    child_costs(c, children.y, weight.y, count, b);
    for (int boxes = 2; boxes <= 8; ++boxes) {
        float best = INFINITY;
        for (int left = 1; left < boxes; ++left) {
            const float cost = a[left - 1] + b[boxes - left - 1];
            best = cost < best ? cost : best;
        }
        shared_out[boxes] = best;
    }
    global float* out = c->costs + 8 * (size_t)node;
    out[7] = shared_out[8];
    float best = NODE_COST + shared_out[8];
    if (range_size(node, c->far_ends) <= LEAF_SIZE && LEAF_COST <= best) best = LEAF_COST;
    out[0] = best;
    for (int boxes = 2; boxes <= 7; ++boxes) {
        best = shared_out[boxes] < best ? shared_out[boxes] : best;
        out[boxes - 1] = best;
    }
}

#include "hierarchy/climb.h"

/// Costs of the nodes of one slice of positions. Before: arrivals are 0.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void collapse_cost(global const Aabb* volumes, global const uint2* children, global const uint* parents,
                   global const uint* far_ends, global handoff_t* arrivals, global float* costs, uint count,
                   uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    if (begin >= count) return;
    const Climb climb = {children, parents, far_ends, arrivals, count};
    const Costs data = {volumes, far_ends, costs};
    climb_slice(&climb, &data, begin, min(begin + slice, count));
}
