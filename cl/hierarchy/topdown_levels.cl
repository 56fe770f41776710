// SPDX-License-Identifier: MIT
// One level of a top-down build: all nodes that are too large for one work-item, cut into chunks of consecutive positions. The
// launches are topdown_bin, topdown_merge, topdown_choose, scans of what choose counted, topdown_scatter, topdown_emit. A level
// starts with roots: topdown_seed, scans, topdown_plant, topdown_measure, topdown_roots.
//
// CHUNK  positions of a chunk
// LARGE  primitives above which a node is split here and not in topdown_subtrees.cl
// Others: hierarchy/split.h, hierarchy/topdown.h.
// compile: CHUNK=64 LARGE=64 BINS=32 BIN_BOX=0 SLICE_PRIMITIVES=16u BLOCK=4 OWN_CENTRES=0 MEASURE=surface_measure COST=measured_cost AXES=all_axes STOP=never FALLBACK_MEASURE=surface_measure FALLBACK_AXES=longest_axes
// compile: CHUNK=64 LARGE=64 BINS=16 BIN_BOX=1 SLICE_PRIMITIVES=1u BLOCK=1 OWN_CENTRES=1 MEASURE=expected_measure COST=measured_cost AXES=facing_axes STOP=threshold_stop FALLBACK_MEASURE=projected_measure FALLBACK_AXES=round_robin_axes
#include "hierarchy/topdown.h"
#include "primitives/segments.h"

#if !defined(CHUNK) || !defined(LARGE)
#error "define CHUNK and LARGE"
#endif

// Large nodes and small ones are counted in one number.
#define ONE_LARGE (1ul << 32)
#define SLOTS (3 * BINS)

/// Positions [begin, end) of a chunk, and the node they are in.
typedef struct Chunk {
    uint node, begin, end;
} Chunk;

INLINE void find_chunk(Chunk* chunk, global const LargeNode* nodes, global const uint* first_chunks, uint node_count, uint i) {
    const uint node = segment_of(first_chunks, node_count, i);
    chunk->node = node;
    chunk->begin = nodes[node].first + (i - first_chunks[node]) * CHUNK;
    chunk->end = min(chunk->begin + CHUNK, nodes[node].first + nodes[node].count);
}

INLINE uint chunks_of(uint count) { return (count - 1) / CHUNK + 1; }

INLINE void grid_of(Grid* grid, global const LargeNode* node) {
    make_grid(grid, vload8(0, node->bounds), vload8(0, node->centres), node->count);
}

/// What a node of `count` primitives adds to the numbers of large nodes, small nodes and chunks.
INLINE ulong kind_of(uint count) { return count > LARGE ? ONE_LARGE : count > 1 ? 1 : 0; }

/// Counts of the trees, by kind, and their chunks. Also writes what is known of a tree: its root's parent, its unused slot.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void topdown_seed(global const uint* offsets, global ulong* kinds, global uint* chunks, global uint* order,
                  global uint2* children, global uint* parents, global uint* far_ends, uint count, uint trees) {
    const uint tree = (uint)get_global_id(0);
    if (tree >= trees) return;
    const uint first = offsets[tree], last = offsets[tree + 1] - 1, size = last - first + 1;
    kinds[tree] = kind_of(size);
    chunks[tree] = size > LARGE ? chunks_of(size) : 0;
    children[last] = (uint2)(BOXWOOD_NONE, BOXWOOD_NONE);
    far_ends[last] = last;
    parents[last] = BOXWOOD_NONE;
    parents[size == 1 ? count + last : first] = BOXWOOD_NONE;
    if (size == 1) order[first] = first;
}

/// Writes the roots of trees as large or small nodes. `kinds` and `chunks` are inclusive scans of what topdown_seed counted.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void topdown_plant(global const uint* offsets, global const ulong* kinds, global const uint* chunks, global LargeNode* nodes,
                   global uint* first_chunks, global SmallNode* small_nodes, uint trees) {
    const uint tree = (uint)get_global_id(0);
    if (tree >= trees) return;
    const uint first = offsets[tree], size = offsets[tree + 1] - first;
    if (size > LARGE) {
        const uint i = (uint)(kinds[tree] >> 32) - 1;
        nodes[i].first = first;
        nodes[i].count = size;
        nodes[i].level = 0;
        nodes[i].flags = 0;
        nodes[i].tree = tree;
        nodes[i].first_chunk = first_chunks[i] = chunks[tree] - chunks_of(size);
    } else if (size > 1) {
        const SmallNode small = {first, size, 0, 0, tree};
        small_nodes[(uint)kinds[tree] - 1] = small;
    }
}

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

/// Bounds of boxes [2 i] and of centres [2 i + 1] of chunk i.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void topdown_measure(global const LargeNode* nodes, global const uint* first_chunks, global const float8* records,
                     global const float* own_centres, global float8* chunk_bounds, uint node_count, uint chunk_count) {
    const uint i = (uint)get_global_id(0);
    if (i >= chunk_count) return;
    Chunk chunk;
    find_chunk(&chunk, nodes, first_chunks, node_count, i);
    float8 bounds = NO_BOUNDS, centres = NO_BOUNDS;
    for (uint p = chunk.begin; p < chunk.end; ++p) {
        bounds = LESSER(records[p], bounds);
        centres = LESSER(point_bounds(centre_of(records[p], own_centres)), centres);
    }
    chunk_bounds[2 * (size_t)i] = bounds;
    chunk_bounds[2 * (size_t)i + 1] = centres;
}

/// Joins bounds `kind` of the chunks of a node.
INLINE float8 join_chunks(global const float8* chunk_bounds, uint first, uint chunks, uint kind) {
    float8 bounds = NO_BOUNDS;
    for (uint i = first; i < first + chunks; ++i) bounds = LESSER(chunk_bounds[2 * (size_t)i + kind], bounds);
    return bounds;
}

kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void topdown_roots(global LargeNode* nodes, global const float8* chunk_bounds, uint node_count) {
    const uint i = (uint)get_global_id(0);
    if (i >= node_count) return;
    const uint first = nodes[i].first_chunk, chunks = chunks_of(nodes[i].count);
    vstore8(join_chunks(chunk_bounds, first, chunks, 0), 0, nodes[i].bounds);
    vstore8(join_chunks(chunk_bounds, first, chunks, 1), 0, nodes[i].centres);
}

/// Boxes and counts of the slices in chunk i, slot j of them at [i * SLOTS + j].
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void topdown_bin(global const LargeNode* nodes, global const uint* first_chunks, global const float8* records,
                 global const float* own_centres, global float8* chunk_bins, global uint* chunk_counts, uint node_count,
                 uint chunk_count) {
    const uint i = (uint)get_global_id(0);
    if (i >= chunk_count) return;
    Chunk chunk;
    find_chunk(&chunk, nodes, first_chunks, node_count, i);
    Grid grid;
    grid_of(&grid, nodes + chunk.node);
    Bins bins;
    bin_records(&bins, &grid, records, own_centres, chunk.begin, chunk.end, BINS);
    for (uint j = 0; j < SLOTS; ++j) {
        chunk_bins[i * (size_t)SLOTS + j] = bins.bounds[j];
        chunk_counts[i * (size_t)SLOTS + j] = bins.counts[j];
    }
}

/// Joins the slots of all chunks of a node, for one slice of slots of all nodes. After: chunk_counts holds what the chunks of the
/// node before hold in that slot.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void topdown_merge(global const LargeNode* nodes, global const float8* chunk_bins, global uint* chunk_counts,
                   global float8* node_bins, global uint* node_counts, uint slots, uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    if (begin >= slots) return;
    const uint end = min(begin + slice, slots);
    for (uint slot = begin; slot < end; ++slot) {
        const uint node = slot / SLOTS, chunks = chunks_of(nodes[node].count);
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

/// Chooses the plane of each node and writes the node; counts the kinds of its children and their chunks. A leaf goes on as a
/// small node, whatever its size: it has nothing to decide any more. After: the first two slots of a node's bins are the bounds of
/// its children.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void topdown_choose(global LargeNode* nodes, global float8* node_bins, global const uint* node_counts,
                    global const Aabb* tree_bounds, global const InfluenceRecord* areas, global const uint* area_starts,
                    global const Thresholds* thresholds, global ulong* kinds, global uint* chunks, global uint* order,
                    global uint2* children, global uint* parents, global uint* far_ends, global uint* marks, uint count,
                    uint node_count) {
    const uint i = (uint)get_global_id(0);
    if (i >= node_count) return;
    const LargeNode node = nodes[i];
    Distribution rays;
    rays_of_tree(tree_bounds, areas, area_starts, node.tree, &rays);
    const Thresholds limits = *thresholds;
    const float8 bounds = vload8(0, nodes[i].bounds);
    const Question question = {bounds, node.count, node.level, slices_of(node.count), chance_of(&rays, bounds, false)};
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
    side_bounds(&bins, plane.axis, plane.slice, question.slices, &left, &right);
    node_bins[i * (size_t)SLOTS] = left;
    node_bins[i * (size_t)SLOTS + 1] = right;
    const uint left_count = plane.left_count;
    const uint right_count = node.count - left_count;
    nodes[i].left_count = left_count;
    nodes[i].cut = 4 * plane.slice + plane.axis;
    kinds[i] = kind_of(left_count) + kind_of(right_count);
    chunks[i] = (left_count > LARGE ? chunks_of(left_count) : 0) + (right_count > LARGE ? chunks_of(right_count) : 0);
    const Nodes written = {order, children, parents, far_ends, marks, count};
    write_node(&written, node.first, node.count, node.flags, left_count, mark);
}

/// Where in its node a chunk's first primitive on the left goes.
INLINE uint lefts_before(global const LargeNode* node, global const uint* counts, const Chunk* chunk) {
    const uint axis = node->cut & 3, slice = node->cut >> 2;
    uint before = 0;
    for (uint s = 0; s < slice; ++s) before += counts[axis * BINS + s];
    return before;
}

/// Moves the records of a chunk to where its node's children want them, in order. Bounds of the centres that go left and
/// right: chunk_bounds[2 i], [2 i + 1].
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void topdown_scatter(global const LargeNode* nodes, global const uint* first_chunks, global const float8* records,
                     global const float* own_centres, global const uint* chunk_counts, global float8* scattered,
                     global float8* chunk_bounds, uint node_count, uint chunk_count) {
    const uint i = (uint)get_global_id(0);
    if (i >= chunk_count) return;
    Chunk chunk;
    find_chunk(&chunk, nodes, first_chunks, node_count, i);
    global const LargeNode* node = nodes + chunk.node;
    if (node->flags & NODE_LEAF) return;
    Grid grid;
    grid_of(&grid, node);
    const int4 limit = plane_at(node->cut & 3, node->cut >> 2);
    const uint middle = node->first + node->left_count;
    const uint lefts = lefts_before(node, chunk_counts + i * (size_t)SLOTS, &chunk);
    const uint rights = chunk.begin - node->first - lefts;
    float8 left, right;
    part_records(&grid, limit, records, own_centres, chunk.begin, chunk.end, scattered, node->first + lefts, middle + rights, &left,
                 &right);
    chunk_bounds[2 * (size_t)i] = left;
    chunk_bounds[2 * (size_t)i + 1] = right;
}

/// Writes the children of each node as large or small nodes of the next level, and single ones as leaves. `kinds` and `chunks` are
/// inclusive scans of what topdown_choose counted, small nodes come after the `small_before` of other levels.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void topdown_emit(global const LargeNode* nodes, global const float8* node_bins, global const float8* scattered,
                  global const float8* chunk_bounds,
                  global const ulong* kinds, global const uint* chunks, global LargeNode* next, global uint* next_chunks,
                  global SmallNode* small_nodes, global uint* order, uint node_count, uint small_before, uint parity) {
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
    const uint node_chunks = chunks_of(node.count);
    for (uint side = 0; side < 2; ++side) {
        const uint first = side == 0 ? node.first : node.first + node.left_count;
        const uint count = side == 0 ? node.left_count : node.count - node.left_count;
        const uint flags = side == 0 ? NODE_LEFT : 0;
        if (count > LARGE) {
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
            chunk += chunks_of(count);
        } else if (count > 1) {
            const SmallNode subtree = {first, count, node.level + 1, flags | (parity ^ NODE_OTHER), node.tree};
            small_nodes[small++] = subtree;
        } else {
            order[first] = index_of(scattered[first]);
        }
    }
}

/// Sums what became of the nodes of one slice: sums[3 i] splits, then axes tried, then fallbacks. After: marks are 1 for leaves.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void topdown_tally(global uint* marks, global uint* sums, uint count, uint slice) {
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
