// SPDX-License-Identifier: MIT
// Collapse of binary trees to `wide8` nodes, level by level from the roots: choose each wide node's children by the
// costs of collapse_cost.cl (Ylitie et al. 2017), number them by scans, write nodes and leaves. Numbering is breadth
// first, so children stand together and after their parents.
//
// TRIANGLE_LEAVES  1: a leaf is a block of up to four triangles; 0: a leaf is one primitive, named by its own index
// NAMED            1: blocks name triangles by a table; 0: by their index within the tree
// compile: TRIANGLE_LEAVES=1 NAMED=0
// compile: TRIANGLE_LEAVES=1 NAMED=1
// compile: TRIANGLE_LEAVES=0 NAMED=0
#include "runtime/numerics.h"
#include "bounds/collinear.h"
#include "primitives/segments.h"
#include "volumes/ranges.h"
#include "layout/plan.h"
#include "shared/node.h"
#include "shared/triangle.h"

#if !defined(TRIANGLE_LEAVES) || !defined(NAMED)
#error "define TRIANGLE_LEAVES and NAMED"
#endif

/// True when `node` as one box is a leaf. The binary node count is below 2^30, so node indices (below 2 count) leave
/// the mark BOXWOOD_LEAF free.
inline bool is_leaf(global const uint* plans, uint node, uint count) {
    return node >= count || (plans[node] & PLAN_LEAF) != 0;
}

/// A pending binary node and the boxes it may become.
typedef struct Pending {
    uint node;
    uint boxes;
} Pending;

/// Children of one wide node made from binary node `root`, left to right, as binary node indices. Returns their number.
inline uint choose(global const uint2* children, global const uint* plans, uint root, uint count, uint* chosen) {
    if (is_leaf(plans, root, count)) {
        chosen[0] = root;
        return 1;
    }
    // The boxes that pending nodes may become add up to at most 8, so 8 entries suffice.
    Pending pending[8];
    pending[0] = (Pending){root, 8};
    uint waiting = 1, found = 0;
    while (waiting > 0) {
        Pending top = pending[--waiting];
        uint left = 0;
        if (top.node < count) {
            const uint word = plans[top.node];
            while (top.boxes > 1 && (left = left_boxes(word, top.boxes)) == 0) --top.boxes;
        }
        if (left == 0) {
            chosen[found++] = top.node;
            continue;
        }
        const uint2 below = children[top.node];
        pending[waiting++] = (Pending){below.y, top.boxes - left};
        pending[waiting++] = (Pending){below.x, left};
    }
    return found;
}

/// sources[t] = the binary node that becomes wide root t: the root of tree t, or its leaf if that is all.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void root_sources(global const uint* offsets, global uint* sources, uint trees, uint count) {
    const uint tree = (uint)get_global_id(0);
    if (tree >= trees) return;
    const bool single = offsets[tree + 1] - offsets[tree] == 1;
    sources[tree] = single ? count + offsets[tree] : offsets[tree];
}

/// For each wide node of one level: wide_children[8 w ..] = its children as binary nodes, leaves marked by
/// BOXWOOD_LEAF; counts[w] = how many inner children, and leaves in the upper half; the rest of wide_children is
/// BOXWOOD_NONE.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void choose_children(global const uint2* children, global const uint* plans, global const uint* sources,
                     global uint* wide_children, global ulong* counts, uint count, uint level_size, uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    const uint end = min(begin + slice, level_size);
    for (uint w = begin; w < end; ++w) {
        uint chosen[8];
        const uint found = choose(children, plans, sources[w], count, chosen);
        uint leaves = 0;
        for (uint i = 0; i < 8; ++i) {
            uint child = BOXWOOD_NONE;
            if (i < found) {
                const bool leaf = is_leaf(plans, chosen[i], count);
                leaves += leaf ? 1u : 0u;
                child = leaf ? chosen[i] | BOXWOOD_LEAF : chosen[i];
            }
            wide_children[8 * (size_t)w + i] = child;
        }
        counts[w] = ((ulong)leaves << 32) | (found - leaves);
    }
    // One entry more, so that the scan ends with the totals.
    if (begin < level_size && end == level_size) counts[end] = 0;
}

/// The children of one level in order: inner_sources is the next level, leaf_sources its leaves. The starts are the
/// exclusive scan of the counts.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void partition_children(global const uint* wide_children, global const ulong* starts, global uint* inner_sources,
                        global uint* leaf_sources, uint level_size, uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    const uint end = min(begin + slice, level_size);
    if (begin >= end) return;
    uint inner = (uint)starts[begin];
    uint leaf = (uint)(starts[begin] >> 32);
    for (uint i = 8 * begin; i < 8 * end; ++i) {
        const uint child = wide_children[i];
        if (child == BOXWOOD_NONE) continue;
        if (child & BOXWOOD_LEAF)
            leaf_sources[leaf++] = child & ~BOXWOOD_LEAF;
        else
            inner_sources[inner++] = child;
    }
}

/// Writes the wide nodes [first_node, first_node + level_size) of one level. Its inner children are numbered from
/// first_node + level_size, its triangle blocks from first_leaf.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void write_nodes(global const Aabb* volumes, global const uint* order, global const uint* wide_children,
                 global const ulong* starts, global Wide8Node* nodes, uint count, uint first_node, uint first_leaf,
                 uint level_size, uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    const uint end = min(begin + slice, level_size);
    for (uint w = begin; w < end; ++w) {
        global Wide8Node* node = nodes + first_node + w;
        uint inner = first_node + level_size + (uint)starts[w];
        uint leaf = first_leaf + (uint)(starts[w] >> 32);
        uint found = 0;
        for (uint i = 0; i < 8; ++i) {
            const uint child = wide_children[8 * (size_t)w + i];
            uint reference = BOXWOOD_NONE;
            float3 low = (float3)(INFINITY), high = (float3)(-INFINITY);
            if (child != BOXWOOD_NONE) {
                const uint source = child & ~BOXWOOD_LEAF;
                ++found;
                low = vload3(0, volumes[source].min);
                high = vload3(0, volumes[source].max);
                if (!(child & BOXWOOD_LEAF))
                    reference = inner++;
                else if (TRIANGLE_LEAVES)
                    reference = BOXWOOD_LEAF | leaf++;
                else
                    reference = BOXWOOD_LEAF | order[source - count];
            }
            node->min_x[i] = low.x;
            node->max_x[i] = high.x;
            node->min_y[i] = low.y;
            node->max_y[i] = high.y;
            node->min_z[i] = low.z;
            node->max_z[i] = high.z;
            node->child[i] = reference;
        }
        node->count = found;
        for (int i = 0; i < 7; ++i) node->reserved[i] = 0;
    }
}

#if TRIANGLE_LEAVES
/// The two in ascending order.
inline void exchange(uint* a, uint* b) {
    const uint low = min(*a, *b);
    *b = max(*a, *b);
    *a = low;
}

inline float3 corner(global const float* positions, global const uint* triangles, uint primitive, uint k) {
    return vload3(triangles[3 * (size_t)primitive + k], positions);
}

/// Four vectors as three rows of four.
inline void store_rows(float3 p0, float3 p1, float3 p2, float3 p3, global float* x, global float* y, global float* z) {
    vstore4((float4)(p0.x, p1.x, p2.x, p3.x), 0, x);
    vstore4((float4)(p0.y, p1.y, p2.y, p3.y), 0, y);
    vstore4((float4)(p0.z, p1.z, p2.z, p3.z), 0, z);
}

/// What a block calls triangle `primitive` of the tree that starts at `first_triangle`.
inline uint name_of(uint primitive, uint first_triangle, global const uint* names) {
    if (primitive == BOXWOOD_NONE) return primitive;
    return NAMED ? names[primitive] : primitive - first_triangle;
}

/// Block of the triangles at positions [range.x, range.y], ascending by primitive, and so by name.
inline void write_block(global Triangle4* block, uint2 range, global const uint* order, global const uint* names,
                        global const float* positions, global const uint* triangles, uint first_triangle) {
    const uint size = range.y - range.x + 1;
    uint p0 = order[range.x];
    uint p1 = size > 1 ? order[range.x + 1] : BOXWOOD_NONE;
    uint p2 = size > 2 ? order[range.x + 2] : BOXWOOD_NONE;
    uint p3 = size > 3 ? order[range.x + 3] : BOXWOOD_NONE;
    exchange(&p0, &p1);
    exchange(&p2, &p3);
    exchange(&p0, &p2);
    exchange(&p1, &p3);
    exchange(&p1, &p2);

    const float3 zero = (float3)(0.0f);
    float3 a0 = zero, a1 = zero, a2 = zero, a3 = zero, b0 = zero, b1 = zero, b2 = zero, b3 = zero, c0 = zero, c1 = zero,
           c2 = zero, c3 = zero;
#define LOAD_TRIANGLE(i)                          \
    a##i = corner(positions, triangles, p##i, 0); \
    b##i = corner(positions, triangles, p##i, 1); \
    c##i = corner(positions, triangles, p##i, 2); \
    mark_collinear(&a##i, &b##i, &c##i)
    LOAD_TRIANGLE(0);
    if (size > 1) {
        LOAD_TRIANGLE(1);
    }
    if (size > 2) {
        LOAD_TRIANGLE(2);
    }
    if (size > 3) {
        LOAD_TRIANGLE(3);
    }
    store_rows(a0, a1, a2, a3, block->v0_x, block->v0_y, block->v0_z);
    store_rows(b0, b1, b2, b3, block->v1_x, block->v1_y, block->v1_z);
    store_rows(c0, c1, c2, c3, block->v2_x, block->v2_y, block->v2_z);
    block->primitive[0] = name_of(p0, first_triangle, names);
    block->primitive[1] = name_of(p1, first_triangle, names);
    block->primitive[2] = name_of(p2, first_triangle, names);
    block->primitive[3] = name_of(p3, first_triangle, names);
}

/// Writes the triangle blocks [first_leaf, first_leaf + leaves) of one level.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void write_blocks(global const uint* leaf_sources, global const uint* far_ends, global const uint* order,
                  global const uint* offsets, global const uint* names, global const float* positions,
                  global const uint* triangles, global Triangle4* blocks, uint count, uint trees, uint first_leaf,
                  uint leaves, uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    const uint end = min(begin + slice, leaves);
    for (uint i = begin; i < end; ++i) {
        const uint2 range = range_of(leaf_sources[i], far_ends, count);
        const uint first_triangle = offsets[segment_of(offsets, trees, range.x)];
        write_block(blocks + first_leaf + i, range, order, names, positions, triangles, first_triangle);
    }
}
#endif
