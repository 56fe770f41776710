// SPDX-License-Identifier: MIT
// Decides bottom-up, by the cost model rather than by a number of primitives, which subtrees become one leaf.
//
// compile:
#include "runtime/numerics.h"
#include "influence/distribution.h"
#include "volumes/ranges.h"
#include "primitives/segments.h"

typedef struct CostedLeaves {
    global const Aabb* volumes;
    global const uint* far_ends;
    global const uint* offsets;
    global const Aabb* tree_bounds;
    global const InfluenceRecord* areas;
    global const uint* area_starts;
    global float* costs;
    global uint* leaves;
    float box_cost;
    float primitive_cost;
    uint trees;
} CostedLeaves;

#define CLIMB_DATA const CostedLeaves*

inline void visit_leaf(const CostedLeaves* c, uint position, uint count) {
    (void)c;
    (void)position;
    (void)count;
}

/// Expected cost of what is below a child, by a ray of the tree.
inline float cost_below(const CostedLeaves* c, const Distribution* rays, uint child, uint count) {
    return child < count ? c->costs[child] : c->primitive_cost * expected_measure(rays, load_box(c->volumes + child));
}

/// costs[node] = the cheaper of both ways; leaves[node] = 1 where that is one leaf. A node that no ray is expected to
/// meet is one.
inline void visit_node(const CostedLeaves* c, uint node, uint2 children, uint count) {
    Distribution rays;
    rays_of_tree(c->tree_bounds, c->areas, c->area_starts, segment_of(c->offsets, c->trees, node), &rays);
    const float probability = expected_measure(&rays, load_box(c->volumes + node));
    const float split = 2.0f * c->box_cost * probability +
                        (cost_below(c, &rays, children.x, count) + cost_below(c, &rays, children.y, count));
    const float whole = c->primitive_cost * probability * (float)range_size(node, c->far_ends);
    c->costs[node] = fmin(whole, split);
    c->leaves[node] = whole <= split ? 1 : 0;
}

#include "volumes/climb.h"

/// Leaves among the nodes of one slice of positions. Before: arrivals are 0.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void costed_leaves(global const Aabb* volumes, global const uint2* children, global const uint* parents,
                   global const uint* far_ends, global handoff_t* arrivals, global const uint* offsets,
                   global const Aabb* tree_bounds, global const InfluenceRecord* areas, global const uint* area_starts,
                   global float* costs, global uint* leaves, float box_cost, float primitive_cost, uint trees,
                   uint count, uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    if (begin >= count) return;
    const Climb climb = {children, parents, far_ends, arrivals, count};
    const CostedLeaves data = {volumes, far_ends, offsets,  tree_bounds,    areas, area_starts,
                               costs,   leaves,   box_cost, primitive_cost, trees};
    climb_slice(&climb, &data, begin, begin + min(slice, count - begin));
}
