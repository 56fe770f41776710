// SPDX-License-Identifier: MIT
// Builds whole subtrees of a top-down build, each by one work-item, in whose cache the records stay. The splits are
// those that topdown_levels.cl would make. Macros: build/split.h.
// compile: BINS=32 BIN_BOX=0 PRIMITIVES_PER_BIN=16u BLOCK_SIZE=4 OWN_CENTRES=0 MEASURE=surface_measure COST=overlap_cost AXES=all_axes STOP=never FALLBACK_MEASURE=surface_measure FALLBACK_AXES=longest_axes
// compile: BINS=16 BIN_BOX=1 PRIMITIVES_PER_BIN=1u BLOCK_SIZE=1 OWN_CENTRES=1 MEASURE=expected_measure COST=measured_cost AXES=facing_axes STOP=threshold_stop FALLBACK_MEASURE=projected_measure FALLBACK_AXES=round_robin_axes
#include "build/split.h"

// The larger child waits and the smaller is gone on with, so that no more than log2 of the primitives wait.
#define MOST_WAITING 32

typedef struct Node {
    float8 bounds, centres;
    uint first, count, level, flags;
} Node;

typedef struct Work {
    const Nodes* nodes;
    const Thresholds* thresholds;
    const Distribution* rays;
    global float8* records[2];
    global const float* centres;
} Work;

/// The bounds of the records of a node.
INLINE void measure_node(const Work* w, Node* node) {
    global const float8* records = w->records[node->flags & NODE_OTHER ? 1 : 0];
    float8 bounds = NO_BOUNDS, centres = NO_BOUNDS;
    for (uint i = node->first; i < node->first + node->count; ++i) {
        const float8 record = records[i];
        bounds = LESSER(record, bounds);
        centres = LESSER(point_bounds(centre_of(record, w->centres)), centres);
    }
    node->bounds = bounds;
    node->centres = centres;
}

/// Moves the records into the other array, those right of the plane behind the others, in order. After: the children's
/// bounds.
INLINE void partition(const Work* w, const Node* node, const Grid* grid, const Bins* bins, uint bin_count,
                      const Plane* plane, Node* children) {
    const bool other = node->flags & NODE_OTHER;
    global const float8* from = w->records[other ? 1 : 0];
    global float8* to = w->records[other ? 0 : 1];
    const int4 limit = plane_at(plane->axis, plane->bin);
    partition_records(grid, limit, from, w->centres, node->first, node->first + node->count, to, node->first,
                      node->first + plane->left_count, &children[0].centres, &children[1].centres);
    side_bounds(bins, plane->axis, plane->bin, bin_count, &children[0].bounds, &children[1].bounds);
    children[0].flags ^= NODE_OTHER;
    children[1].flags ^= NODE_OTHER;
}

/// Splits a node of two primitives or more in two.
INLINE void split_node(const Work* w, const Node* node, Node* children) {
    Plane plane;
    no_plane(&plane);
    uint mark = MARK_LEAF;
    Grid grid;
    Bins bins;
    const Question question = {node->bounds, node->count, node->level, bins_for(node->count),
                               node->flags & NODE_LEAF ? 0.0f : probability_of(w->rays, node->bounds, false)};
    if (!(node->flags & NODE_LEAF) && !is_leaf(w->rays, w->thresholds, &question)) {
        global const float8* records = w->records[node->flags & NODE_OTHER ? 1 : 0];
        make_grid(&grid, node->bounds, node->centres, node->count);
        bin_records(&bins, &grid, records, w->centres, node->first, node->first + node->count, question.bin_count);
        mark = choose_plane(w->rays, w->thresholds, &bins, &question, &plane);
    }
    const bool leaf = plane.axis == NO_AXIS; // also when no plane parts it
    const uint left_count = leaf ? node->count / 2 : plane.left_count;
    const uint kept = (node->flags & NODE_OTHER) | (leaf ? NODE_LEAF : 0);
    children[0].first = node->first;
    children[0].count = left_count;
    children[0].flags = kept | NODE_LEFT;
    children[1].first = node->first + left_count;
    children[1].count = node->count - left_count;
    children[1].flags = kept;
    children[0].level = children[1].level = node->level + 1;
    write_node(w->nodes, node->first, node->count, node->flags, left_count, leaf ? MARK_LEAF : mark);
    if (!leaf) partition(w, node, &grid, &bins, question.bin_count, &plane, children);
}

INLINE void build_subtree(const Work* w, Node root) {
    Node waiting[MOST_WAITING];
    uint depth = 0;
    Node node = root;
    while (true) {
        Node children[2];
        split_node(w, &node, children);
        for (uint side = 0; side < 2; ++side) {
            if (children[side].count > 1) continue;
            const float8 record = w->records[children[side].flags & NODE_OTHER ? 1 : 0][children[side].first];
            w->nodes->order[children[side].first] = index_of(record);
        }
        const uint smaller = children[1].count < children[0].count ? 1 : 0;
        if (children[smaller].count > 1) {
            waiting[depth++] = children[1 - smaller];
            node = children[smaller];
        } else if (children[1 - smaller].count > 1) {
            node = children[1 - smaller];
        } else if (depth > 0) {
            node = waiting[--depth];
        } else {
            return;
        }
    }
}

/// The subtrees of one slice of small nodes.
/// Before: the records of small node i are in the array that its flags say; no others are at its positions. Its own
/// entry in `parents` is written.
/// After all work-items: everything below the small nodes is written, `order` at their positions too.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void topdown_subtrees(global const SmallNode* small_nodes, global float8* records, global float8* other_records,
                      global const float* centres, global const Aabb* tree_bounds, global const InfluenceRecord* areas,
                      global const uint* area_starts, global const Thresholds* thresholds, global uint* order,
                      global uint2* children, global uint* parents, global uint* far_ends, global uint* marks,
                      uint count, uint small_count, uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    if (begin >= small_count) return;
    const uint end = min(begin + slice, small_count);
    const Nodes nodes = {order, children, parents, far_ends, marks, count};
    const Thresholds limits = *thresholds;
    for (uint i = begin; i < end; ++i) {
        const SmallNode small = small_nodes[i];
        Distribution rays;
        rays_of_tree(tree_bounds, areas, area_starts, small.tree, &rays);
        const Work work = {&nodes, &limits, &rays, {records, other_records}, centres};
        Node root;
        root.first = small.first;
        root.count = small.count;
        root.level = small.level;
        root.flags = small.flags;
        measure_node(&work, &root);
        build_subtree(&work, root);
    }
}
