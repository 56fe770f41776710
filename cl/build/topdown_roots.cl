// SPDX-License-Identifier: MIT
// The steps of a top-down build before and after its levels, which do not depend on the strategy: topdown_records,
// topdown_seed, scans of what it counted, topdown_emit_roots, topdown_measure, topdown_roots; finally
// topdown_sum_marks.
//
// Macros: build/record.h.
// compile: OWN_CENTRES=0
// compile: OWN_CENTRES=1
#include "build/record.h"
#include "build/topdown.h"

/// Records of primitives in the order of their indices, which is the order of a stable build's start.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void topdown_records(global const Aabb* boxes, global float8* records, uint count, uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    if (begin >= count) return;
    const uint end = min(begin + slice, count);
    for (uint i = begin; i < end; ++i) {
        const Box box = load_box(boxes + i);
        records[i] = (float8)(box.a.xyz, as_float(i | INDEX_MARK), -box.a.w, -box.b, INFINITY);
    }
}

/// Counts of the trees, by kind, and their chunks. Also writes what is known of a tree: its root's parent, its unused
/// slot.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void topdown_seed(global const uint* offsets, global ulong* kinds, global uint* chunks, global uint* order,
                  global uint2* children, global uint* parents, global uint* far_ends, uint count, uint trees,
                  uint chunk_size) {
    const uint tree = (uint)get_global_id(0);
    if (tree >= trees) return;
    const uint first = offsets[tree], last = offsets[tree + 1] - 1, size = last - first + 1;
    kinds[tree] = kind_of(size, chunk_size);
    chunks[tree] = chunks_of(size, chunk_size);
    children[last] = (uint2)(BOXWOOD_NONE, BOXWOOD_NONE);
    far_ends[last] = last;
    parents[last] = BOXWOOD_NONE;
    parents[size == 1 ? count + last : first] = BOXWOOD_NONE;
    if (size == 1) order[first] = first;
}

/// Writes the roots of trees as large or small nodes. `kinds` and `chunks` are inclusive scans of what topdown_seed
/// counted.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void topdown_emit_roots(global const uint* offsets, global const ulong* kinds, global const uint* chunks,
                        global LargeNode* nodes, global uint* first_chunks, global SmallNode* small_nodes, uint trees,
                        uint chunk_size) {
    const uint tree = (uint)get_global_id(0);
    if (tree >= trees) return;
    const uint first = offsets[tree], size = offsets[tree + 1] - first;
    if (size > chunk_size) {
        const uint i = (uint)(kinds[tree] >> 32) - 1;
        nodes[i].first = first;
        nodes[i].count = size;
        nodes[i].level = 0;
        nodes[i].flags = 0;
        nodes[i].tree = tree;
        nodes[i].first_chunk = first_chunks[i] = chunks[tree] - chunks_of(size, chunk_size);
    } else if (size > 1) {
        const SmallNode small = {first, size, 0, 0, tree};
        small_nodes[(uint)kinds[tree] - 1] = small;
    }
}

/// Bounds of boxes [2 i] and of centres [2 i + 1] of chunk i.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void topdown_measure(global const LargeNode* nodes, global const uint* first_chunks, global const float8* records,
                     global const float* own_centres, global float8* chunk_bounds, uint node_count, uint chunk_count,
                     uint chunk_size) {
    const uint i = (uint)get_global_id(0);
    if (i >= chunk_count) return;
    Chunk chunk;
    find_chunk(&chunk, nodes, first_chunks, node_count, chunk_size, i);
    float8 bounds = NO_BOUNDS, centres = NO_BOUNDS;
    for (uint p = chunk.begin; p < chunk.end; ++p) {
        bounds = LESSER(records[p], bounds);
        centres = LESSER(point_bounds(centre_of(records[p], own_centres)), centres);
    }
    chunk_bounds[2 * (size_t)i] = bounds;
    chunk_bounds[2 * (size_t)i + 1] = centres;
}

kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void topdown_roots(global LargeNode* nodes, global const float8* chunk_bounds, uint node_count, uint chunk_size) {
    const uint i = (uint)get_global_id(0);
    if (i >= node_count) return;
    const uint first = nodes[i].first_chunk, chunks = chunks_of(nodes[i].count, chunk_size);
    vstore8(join_chunks(chunk_bounds, first, chunks, 0), 0, nodes[i].bounds);
    vstore8(join_chunks(chunk_bounds, first, chunks, 1), 0, nodes[i].centres);
}

/// Sums what became of the nodes of one slice: sums[3 i] splits, then axes tried, then fallbacks. After: marks are 1
/// for leaves.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void topdown_sum_marks(global uint* marks, global uint* sums, uint count, uint slice) {
    const uint i = (uint)get_global_id(0), begin = i * slice;
    if (begin >= count) return;
    const uint end = min(begin + slice, count);
    uint splits = 0, tried = 0, fallbacks = 0;
    for (uint node = begin; node < end; ++node) {
        const uint mark = marks[node];
        splits += mark & MARK_SPLIT ? 1 : 0;
        tried += mark / MARK_TRIED;
        fallbacks += mark & MARK_FALLBACK ? 1 : 0;
        marks[node] = mark & MARK_LEAF;
    }
    sums[3 * (size_t)i] = splits;
    sums[3 * (size_t)i + 1] = tried;
    sums[3 * (size_t)i + 2] = fallbacks;
}
