// SPDX-License-Identifier: MIT
// Chooses the plane at which the strategy splits each large node of one level of a top-down build.
//
// Macros: build/split.h.
// compile: BINS=32 BIN_BOX=0 PRIMITIVES_PER_BIN=16u BLOCK_SIZE=4 OWN_CENTRES=0 MEASURE=surface_measure COST=measured_cost AXES=all_axes STOP=never FALLBACK_MEASURE=surface_measure FALLBACK_AXES=longest_axes
// compile: BINS=16 BIN_BOX=1 PRIMITIVES_PER_BIN=1u BLOCK_SIZE=1 OWN_CENTRES=1 MEASURE=expected_measure COST=measured_cost AXES=facing_axes STOP=threshold_stop FALLBACK_MEASURE=projected_measure FALLBACK_AXES=round_robin_axes
#include "build/split.h"

/// Chooses the plane of each node and writes the node; counts the kinds of its children and their chunks. A leaf goes
/// on as a small node, whatever its size: it has nothing to decide any more. After: the first two slots of a node's
/// bins are the bounds of its children.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void topdown_choose(global LargeNode* nodes, global float8* node_bins, global const uint* node_counts,
                    global const Aabb* tree_bounds, global const InfluenceRecord* areas, global const uint* area_starts,
                    global const Thresholds* thresholds, global ulong* kinds, global uint* chunks, global uint* order,
                    global uint2* children, global uint* parents, global uint* far_ends, global uint* marks, uint count,
                    uint node_count, uint chunk_size) {
    const uint i = (uint)get_global_id(0);
    if (i >= node_count) return;
    const LargeNode node = nodes[i];
    Distribution rays;
    rays_of_tree(tree_bounds, areas, area_starts, node.tree, &rays);
    const Thresholds limits = *thresholds;
    const float8 bounds = vload8(0, nodes[i].bounds);
    const Question question = {bounds, node.count, node.level, bins_for(node.count),
                               probability_of(&rays, bounds, false)};
    Plane plane;
    no_plane(&plane);
    uint mark = MARK_LEAF;
    Bins bins;
    if (!is_leaf(&rays, &limits, &question)) {
        for (uint j = 0; j < SLOTS; ++j) {
            bins.bounds[j] = node_bins[i * (size_t)SLOTS + j];
            bins.counts[j] = node_counts[i * (size_t)SLOTS + j];
        }
        mark = choose_plane(&rays, &limits, &bins, &question, &plane);
    }
    if (plane.axis == NO_AXIS) {
        nodes[i].flags = node.flags | NODE_LEAF;
        kinds[i] = 1;
        chunks[i] = 0;
        return;
    }
    float8 left, right;
    side_bounds(&bins, plane.axis, plane.bin, question.bin_count, &left, &right);
    node_bins[i * (size_t)SLOTS] = left;
    node_bins[i * (size_t)SLOTS + 1] = right;
    const uint left_count = plane.left_count;
    const uint right_count = node.count - left_count;
    nodes[i].left_count = left_count;
    nodes[i].cut = 4 * plane.bin + plane.axis;
    kinds[i] = kind_of(left_count, chunk_size) + kind_of(right_count, chunk_size);
    chunks[i] = chunks_of(left_count, chunk_size) + chunks_of(right_count, chunk_size);
    const Nodes written = {order, children, parents, far_ends, marks, count};
    write_node(&written, node.first, node.count, node.flags, left_count, mark);
}
