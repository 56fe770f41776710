// SPDX-License-Identifier: MIT
// Common to the kernels of the top-down builder: writing nodes, and cutting large ones into chunks.
//
// Macros: build/record.h.
#ifndef BOXWOOD_BUILD_TOPDOWN_H
#define BOXWOOD_BUILD_TOPDOWN_H
#include "build/record.h"
#include "primitives/segments.h"
#include "runtime/inline.h"
#include "shared/topdown.h"

// What became of a node, in TopDownTree::leaves until they are told apart: MARK_LEAF, and of a split node the axes
// tried.
#define MARK_LEAF 1u
#define MARK_SPLIT 2u
#define MARK_FALLBACK 4u
#define MARK_TRIED 8u // times the axes

/// As in Topology (include/boxwood/topology.hpp).
typedef struct Nodes {
    global uint* order;
    global uint2* children;
    global uint* parents;
    global uint* far_ends;
    global uint* marks; ///< MARK_..., by inner node
    uint count;         ///< Primitives of all trees.
} Nodes;

/// The index of the inner node over the positions from `first`.
INLINE uint node_index(uint first, uint count, uint flags) { return flags & NODE_LEFT ? first + count - 1 : first; }

/// Writes an inner node and its children's parent.
INLINE void write_node(const Nodes* n, uint first, uint count, uint flags, uint left_count, uint mark) {
    const uint index = node_index(first, count, flags), middle = first + left_count;
    const uint left = left_count == 1 ? n->count + first : middle - 1;
    const uint right = left_count + 1 == count ? n->count + middle : middle;
    n->children[index] = (uint2)(left, right);
    n->far_ends[index] = flags & NODE_LEFT ? first : first + count - 1;
    n->parents[left] = index;
    n->parents[right] = index;
    n->marks[index] = mark;
}

// Nodes of more primitives than `chunk_size` are large: whole launches work on them, cut into chunks of so many
// consecutive positions. Large nodes and small ones are counted in one number.
#define ONE_LARGE (1ul << 32)

/// Positions [begin, end) of a chunk, and the node they are in.
typedef struct Chunk {
    uint node, begin, end;
} Chunk;

INLINE void find_chunk(Chunk* chunk, global const LargeNode* nodes, global const uint* first_chunks, uint node_count,
                       uint chunk_size, uint i) {
    const uint node = segment_of(first_chunks, node_count, i);
    chunk->node = node;
    chunk->begin = nodes[node].first + (i - first_chunks[node]) * chunk_size;
    chunk->end = min(chunk->begin + chunk_size, nodes[node].first + nodes[node].count);
}

/// Chunks of a node of `count` primitives: none of a small one.
INLINE uint chunks_of(uint count, uint chunk_size) { return count > chunk_size ? (count - 1) / chunk_size + 1 : 0; }

/// What a node of `count` primitives adds to the numbers of large nodes, small nodes and chunks.
INLINE ulong kind_of(uint count, uint chunk_size) { return count > chunk_size ? ONE_LARGE : count > 1 ? 1 : 0; }

/// Joins bounds `kind` of the chunks of a node.
INLINE float8 join_chunks(global const float8* chunk_bounds, uint first, uint chunks, uint kind) {
    float8 bounds = NO_BOUNDS;
    for (uint i = first; i < first + chunks; ++i) bounds = LESSER(chunk_bounds[2 * (size_t)i + kind], bounds);
    return bounds;
}

#endif
