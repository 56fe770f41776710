// SPDX-License-Identifier: MIT
// One level of a top-down build: all nodes that are too large for one work-item, cut into chunks of consecutive
// positions. The launches are topdown_bin, topdown_merge, topdown_choose (topdown_choose.cl), scans of what it counted,
// topdown_scatter, topdown_emit.
//
// Macros: build/bins.h.
// compile: BINS=32 BIN_BOX=0 PRIMITIVES_PER_BIN=16u OWN_CENTRES=0
// compile: BINS=16 BIN_BOX=1 PRIMITIVES_PER_BIN=1u OWN_CENTRES=1
#include "build/bins.h"
#include "build/topdown.h"

INLINE void grid_of(Grid* grid, global const LargeNode* node) {
    make_grid(grid, vload8(0, node->bounds), vload8(0, node->centres), node->count);
}

/// Boxes and counts of the bins in chunk i, slot j of them at [i * SLOTS + j].
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void topdown_bin(global const LargeNode* nodes, global const uint* first_chunks, global const float8* records,
                 global const float* own_centres, global float8* chunk_bins, global uint* chunk_counts, uint node_count,
                 uint chunk_count, uint chunk_size) {
    const uint i = (uint)get_global_id(0);
    if (i >= chunk_count) return;
    Chunk chunk;
    find_chunk(&chunk, nodes, first_chunks, node_count, chunk_size, i);
    Grid grid;
    grid_of(&grid, nodes + chunk.node);
    Bins bins;
    bin_records(&bins, &grid, records, own_centres, chunk.begin, chunk.end, BINS);
    for (uint j = 0; j < SLOTS; ++j) {
        chunk_bins[i * (size_t)SLOTS + j] = bins.bounds[j];
        chunk_counts[i * (size_t)SLOTS + j] = bins.counts[j];
    }
}

/// Joins the slots of all chunks of a node, for one slice of slots of all nodes. After: chunk_counts holds what the
/// chunks of the node before hold in that slot.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void topdown_merge(global const LargeNode* nodes, global const float8* chunk_bins, global uint* chunk_counts,
                   global float8* node_bins, global uint* node_counts, uint slots, uint slice, uint chunk_size) {
    const uint begin = (uint)get_global_id(0) * slice;
    if (begin >= slots) return;
    const uint end = min(begin + slice, slots);
    for (uint slot = begin; slot < end; ++slot) {
        const uint node = slot / SLOTS, chunks = chunks_of(nodes[node].count, chunk_size);
        size_t at = nodes[node].first_chunk * (size_t)SLOTS + slot % SLOTS;
        float8 bounds = NO_BOUNDS;
        uint count = 0;
        for (uint i = 0; i < chunks; ++i, at += SLOTS) {
            const uint own = chunk_counts[at];
            chunk_counts[at] = count;
            count += own;
            bounds = LESSER(chunk_bins[at], bounds);
        }
        node_bins[slot] = bounds;
        node_counts[slot] = count;
    }
}

/// Where in its node a chunk's first primitive on the left goes.
INLINE uint lefts_before(global const LargeNode* node, global const uint* counts, const Chunk* chunk) {
    const uint axis = node->cut & 3, bin = node->cut >> 2;
    uint before = 0;
    for (uint s = 0; s < bin; ++s) before += counts[axis * BINS + s];
    return before;
}

/// Moves the records of a chunk to where its node's children want them, in order. Bounds of the centres that go left
/// and right: chunk_bounds[2 i], [2 i + 1].
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void topdown_scatter(global const LargeNode* nodes, global const uint* first_chunks, global const float8* records,
                     global const float* own_centres, global const uint* chunk_counts, global float8* scattered,
                     global float8* chunk_bounds, uint node_count, uint chunk_count, uint chunk_size) {
    const uint i = (uint)get_global_id(0);
    if (i >= chunk_count) return;
    Chunk chunk;
    find_chunk(&chunk, nodes, first_chunks, node_count, chunk_size, i);
    global const LargeNode* node = nodes + chunk.node;
    if (node->flags & NODE_LEAF) return;
    Grid grid;
    grid_of(&grid, node);
    const int4 limit = plane_at(node->cut & 3, node->cut >> 2);
    const uint middle = node->first + node->left_count;
    const uint lefts = lefts_before(node, chunk_counts + i * (size_t)SLOTS, &chunk);
    const uint rights = chunk.begin - node->first - lefts;
    float8 left, right;
    partition_records(&grid, limit, records, own_centres, chunk.begin, chunk.end, scattered, node->first + lefts,
                      middle + rights, &left, &right);
    chunk_bounds[2 * (size_t)i] = left;
    chunk_bounds[2 * (size_t)i + 1] = right;
}

/// Writes the children of each node as large or small nodes of the next level, and single ones as leaves. `kinds` and
/// `chunks` are inclusive scans of what topdown_choose counted, small nodes come after the `small_before` of other
/// levels.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void topdown_emit(global const LargeNode* nodes, global const float8* node_bins, global const float8* scattered,
                  global const float8* chunk_bounds, global const ulong* kinds, global const uint* chunks,
                  global LargeNode* next, global uint* next_chunks, global SmallNode* small_nodes, global uint* order,
                  uint node_count, uint small_before, uint parity, uint chunk_size) {
    const uint i = (uint)get_global_id(0);
    if (i >= node_count) return;
    const LargeNode node = nodes[i];
    const ulong before = i > 0 ? kinds[i - 1] : 0;
    uint large = (uint)(before >> 32), small = small_before + (uint)before, chunk = i > 0 ? chunks[i - 1] : 0;
    if (node.flags & NODE_LEAF) {
        const SmallNode leaf = {node.first, node.count, node.level, node.flags | parity, node.tree};
        small_nodes[small] = leaf;
        return;
    }
    const uint node_chunks = chunks_of(node.count, chunk_size);
    for (uint side = 0; side < 2; ++side) {
        const uint first = side == 0 ? node.first : node.first + node.left_count;
        const uint count = side == 0 ? node.left_count : node.count - node.left_count;
        const uint flags = side == 0 ? NODE_LEFT : 0;
        if (count > chunk_size) {
            global LargeNode* child = next + large++;
            vstore8(node_bins[i * (size_t)SLOTS + side], 0, child->bounds);
            vstore8(join_chunks(chunk_bounds, node.first_chunk, node_chunks, side), 0, child->centres);
            child->first = first;
            child->count = count;
            child->level = node.level + 1;
            child->flags = flags;
            child->tree = node.tree;
            child->first_chunk = chunk;
            next_chunks[large - 1] = chunk;
            chunk += chunks_of(count, chunk_size);
        } else if (count > 1) {
            const SmallNode subtree = {first, count, node.level + 1, flags | (parity ^ NODE_OTHER), node.tree};
            small_nodes[small++] = subtree;
        } else {
            order[first] = index_of(scattered[first]);
        }
    }
}
