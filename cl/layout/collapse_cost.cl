// SPDX-License-Identifier: MIT
// How to cover each subtree by wide nodes at least cost: the dynamic program of Ylitie, Karras and Laine ("Efficient
// incoherent ray traversal on GPUs through compressed wide BVHs", 2017, section 3.1), bottom-up.
//
// costs[8 n + i - 1], i = 1..7: least cost of the subtree of inner node n, no leaf, when it may hang from its wide
// parent as up to i boxes ([8 n + 7] repeats i = 7). All are expected costs per ray that hits n's box, so they are free
// of scale and neither overflow nor vanish.
//
// A subtree of up to LEAF_SIZE primitives is one leaf: its test costs the same however many of its slots are filled.
//
// LEAF_SIZE  most primitives in a leaf
// NODE_COST  cost of testing one wide node (float)
// LEAF_COST  cost of testing one leaf (float)
// compile: LEAF_SIZE=4 NODE_COST=1.0f LEAF_COST=1.0f
#include "runtime/numerics.h"
#include "bounds/box.h"
#include "volumes/ranges.h"
#include "layout/plan.h"

#if !defined(LEAF_SIZE) || !defined(NODE_COST) || !defined(LEAF_COST)
#error "define LEAF_SIZE, NODE_COST and LEAF_COST"
#endif

typedef struct Costs {
    global const Aabb* volumes;
    global const uint* far_ends;
    global float* costs;
    global uint* plans;
} Costs;

#define CLIMB_DATA const Costs*

inline void visit_leaf(const Costs* c, uint position, uint count) {
    (void)c;
    (void)position;
    (void)count;
}

inline float half_area(float3 extent) { return extent.x * extent.y + extent.y * extent.z + extent.z * extent.x; }

/// Probability that a ray that hits `parent` hits `a` and `b`, by surface area. Extents are first divided by the
/// parent's largest, so that no product leaves the range of floats. A parent without area counts as always hit.
inline float2 hit_probabilities(Box parent, Box a, Box b) {
    const float3 extent = extent_of(parent);
    const float unit = max(max(extent.x, extent.y), extent.z);
    const float whole = half_area(extent / unit);
    if (!(whole > 0.0f)) return (float2)(1.0f, 1.0f); // also when the unit was 0 and the quotients NaN
    return (float2)(half_area(extent_of(a) / unit), half_area(extent_of(b) / unit)) / whole;
}

inline bool is_leaf(const Costs* c, uint node, uint count) { return node_size(node, c->far_ends, count) <= LEAF_SIZE; }

/// A child's costs, weighted by the probability that a ray that hits the parent hits it.
inline float8 child_costs(const Costs* c, uint child, float weight, uint count) {
    return weight * (is_leaf(c, child, count) ? (float8)(LEAF_COST) : vload8(child, c->costs));
}

/// One step of the search for the best division: the left child gets `s` of the boxes, at cost `left`; lane j - 1 of
/// `right` is the cost of the other child with j - s boxes, infinite where that is none.
inline void try_left(float left, float8 right, int s, float8* best, int8* left_boxes) {
    const float8 cost = left + right;
    const int8 better = cost < *best;
    *best = select(*best, cost, better);
    *left_boxes = select(*left_boxes, (int8)(s), better);
}

/// Costs and choices of a node from those of its children. Lane j - 1 of the work is for j boxes.
inline void visit_node(const Costs* c, uint node, uint2 children, uint count) {
    if (is_leaf(c, node, count)) {
        c->plans[node] = PLAN_LEAF;
        return;
    }
    const float2 weight = hit_probabilities(load_box(c->volumes + node), load_box(c->volumes + children.x),
                                            load_box(c->volumes + children.y));
    const float8 a = child_costs(c, children.x, weight.x, count);
    const float8 b = child_costs(c, children.y, weight.y, count);
    const float none = INFINITY;
    float8 best = (float8)(none);
    int8 left_boxes = (int8)(0);
    try_left(a.s0, (float8)(none, b.s0, b.s1, b.s2, b.s3, b.s4, b.s5, b.s6), 1, &best, &left_boxes);
    try_left(a.s1, (float8)(none, none, b.s0, b.s1, b.s2, b.s3, b.s4, b.s5), 2, &best, &left_boxes);
    try_left(a.s2, (float8)(none, none, none, b.s0, b.s1, b.s2, b.s3, b.s4), 3, &best, &left_boxes);
    try_left(a.s3, (float8)(none, none, none, none, b.s0, b.s1, b.s2, b.s3), 4, &best, &left_boxes);
    try_left(a.s4, (float8)(none, none, none, none, none, b.s0, b.s1, b.s2), 5, &best, &left_boxes);
    try_left(a.s5, (float8)(none, none, none, none, none, none, b.s0, b.s1), 6, &best, &left_boxes);
    try_left(a.s6, (float8)(none, none, none, none, none, none, none, b.s0), 7, &best, &left_boxes);
    // Lane 0: the node as one box, a wide node of its own. Lane j - 1: never dearer than with fewer boxes.
    const float8 cost = (float8)(NODE_COST + best.s7, best.s1, best.s2, best.s3, best.s4, best.s5, best.s6, none);
    float8 fewer = (float8)(none, cost.s0, cost.s1, cost.s2, cost.s3, cost.s4, cost.s5, cost.s6);
    fewer = LESSER(fewer, (float8)(none, fewer.s0, fewer.s1, fewer.s2, fewer.s3, fewer.s4, fewer.s5, fewer.s6));
    fewer = LESSER(fewer, (float8)(none, none, fewer.s0, fewer.s1, fewer.s2, fewer.s3, fewer.s4, fewer.s5));
    fewer = LESSER(fewer, (float8)(none, none, none, none, fewer.s0, fewer.s1, fewer.s2, fewer.s3));
    vstore8(LESSER(cost, fewer), node, c->costs);

    const int8 kept = (cost < fewer) & left_boxes;
    const int8 bits = kept << (int8)(0, 0, 3, 6, 9, 12, 15, 0);
    c->plans[node] = (uint)(bits.s1 | bits.s2 | bits.s3 | bits.s4 | bits.s5 | bits.s6) | (uint)left_boxes.s7 << 18;
}

#include "volumes/climb.h"

/// Costs and plans of the nodes of one slice of positions. Before: arrivals are 0.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void collapse_cost(global const Aabb* volumes, global const uint2* children, global const uint* parents,
                   global const uint* far_ends, global handoff_t* arrivals, global float* costs, global uint* plans,
                   uint count, uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    if (begin >= count) return;
    const Climb climb = {children, parents, far_ends, arrivals, count};
    const Costs data = {volumes, far_ends, costs, plans};
    climb_slice(&climb, &data, begin, min(begin + slice, count));
}
