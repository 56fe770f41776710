// SPDX-License-Identifier: MIT
// Collapse of a binary forest to `wide8` nodes, level by level from the roots: choose each wide node's children by the
// costs of collapse_cost.cl (Ylitie et al. 2017), number them by scans, write nodes and leaves. Numbering is breadth
// first, so children stand together and after their parents.
//
// TRIANGLE_LEAVES  1: a leaf is a block of up to four triangles; 0: a leaf is one primitive, named by its own index
// compile: TRIANGLE_LEAVES=1
// compile: TRIANGLE_LEAVES=0
#include "runtime/numerics.h"
#include "hierarchy/forest.h"
#include "hierarchy/shares.h"
#include "shared/node.h"
#include "shared/triangle.h"

#ifndef TRIANGLE_LEAVES
#error "define TRIANGLE_LEAVES"
#endif

/// True when `node` as one box is a leaf. The binary node count is below 2^30, so node indices (below 2 count) leave the
/// mark BOXWOOD_LEAF free.
inline bool is_leaf(global const uint* shares, uint node, uint count) {
    return node >= count || (shares[node] & SHARES_LEAF) != 0;
}

/// A pending binary node and the boxes it may become.
typedef struct Share {
    uint node;
    uint boxes;
} Share;

/// Children of one wide node made from binary node `root`, left to right, as binary node indices. Returns their number.
inline uint choose(global const uint2* children, global const uint* shares, uint root, uint count, uint* chosen) {
    if (is_leaf(shares, root, count)) {
        chosen[0] = root;
        return 1;
    }
    // The boxes that pending nodes may become add up to at most 8, so 8 entries suffice.
    Share pending[8];
    pending[0] = (Share){root, 8};
    uint waiting = 1, found = 0;
    while (waiting > 0) {
        Share top = pending[--waiting];
        uint left = 0;
        if (top.node < count) {
            const uint word = shares[top.node];
            while (top.boxes > 1 && (left = share_of(word, top.boxes)) == 0) --top.boxes;
        }
        if (left == 0) {
            chosen[found++] = top.node;
            continue;
        }
        const uint2 below = children[top.node];
        pending[waiting++] = (Share){below.y, top.boxes - left};
        pending[waiting++] = (Share){below.x, left};
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

/// totals[0] = {inner children, leaves} of a level: the ends of its two scans.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void level_totals(global const uint* inner_starts, global const uint* leaf_starts, global uint2* totals,
                  uint level_size) {
    if (get_global_id(0) == 0) totals[0] = (uint2)(inner_starts[level_size], leaf_starts[level_size]);
}

/// For each wide node of one level: kids[8 w ..] = its children as binary nodes, leaves marked by BOXWOOD_LEAF;
/// inner_counts[w], leaf_counts[w] = how many of each; the rest of kids is BOXWOOD_NONE.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void choose_children(global const uint2* children, global const uint* shares, global const uint* sources,
                     global uint* kids, global uint* inner_counts, global uint* leaf_counts, uint count,
                     uint level_size) {
    const uint w = (uint)get_global_id(0);
    if (w == level_size) inner_counts[w] = leaf_counts[w] = 0; // so that the scans end with the totals
    if (w >= level_size) return;
    uint chosen[8];
    const uint found = choose(children, shares, sources[w], count, chosen);
    uint leaves = 0;
    for (uint i = 0; i < 8; ++i) {
        uint kid = BOXWOOD_NONE;
        if (i < found) {
            const bool leaf = is_leaf(shares, chosen[i], count);
            leaves += leaf ? 1u : 0u;
            kid = leaf ? chosen[i] | BOXWOOD_LEAF : chosen[i];
        }
        kids[8 * (size_t)w + i] = kid;
    }
    inner_counts[w] = found - leaves;
    leaf_counts[w] = leaves;
}

/// next_sources[...] = the inner children of this level in order; inner_starts is the exclusive scan of inner_counts.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void next_level(global const uint* kids, global const uint* inner_starts, global uint* next_sources, uint level_size) {
    const uint w = (uint)get_global_id(0);
    if (w >= level_size) return;
    uint place = inner_starts[w];
    for (uint i = 0; i < 8; ++i) {
        const uint kid = kids[8 * (size_t)w + i];
        if (kid != BOXWOOD_NONE && !(kid & BOXWOOD_LEAF)) next_sources[place++] = kid;
    }
}

#if TRIANGLE_LEAVES
/// Block of the triangles at positions [range.x, range.y], ascending by primitive; primitives are counted from
/// `first_triangle`, the start of their mesh.
inline void write_block(global Triangle4* block, uint2 range, global const uint* order, global const float* positions,
                        global const uint* triangles, uint first_triangle) {
    uint sorted[4];
    const uint size = range.y - range.x + 1;
    for (uint i = 0; i < size; ++i) {
        const uint primitive = order[range.x + i];
        uint place = i;
        for (; place > 0 && sorted[place - 1] > primitive; --place) sorted[place] = sorted[place - 1];
        sorted[place] = primitive;
    }
    for (uint i = 0; i < 4; ++i) {
        float a[3] = {0.0f, 0.0f, 0.0f}, ab[3] = {0.0f, 0.0f, 0.0f}, ac[3] = {0.0f, 0.0f, 0.0f};
        if (i < size) {
            global const uint* corner = triangles + 3 * (size_t)sorted[i];
            for (int k = 0; k < 3; ++k) {
                a[k] = positions[3 * (size_t)corner[0] + k];
                ab[k] = positions[3 * (size_t)corner[1] + k] - a[k];
                ac[k] = positions[3 * (size_t)corner[2] + k] - a[k];
            }
        }
        block->v0_x[i] = a[0];
        block->v0_y[i] = a[1];
        block->v0_z[i] = a[2];
        block->edge1_x[i] = ab[0];
        block->edge1_y[i] = ab[1];
        block->edge1_z[i] = ab[2];
        block->edge2_x[i] = ac[0];
        block->edge2_y[i] = ac[1];
        block->edge2_z[i] = ac[2];
        block->primitive[i] = i < size ? sorted[i] - first_triangle : BOXWOOD_NONE;
    }
}
#endif

#if TRIANGLE_LEAVES
#define LEAF_PARAMETERS                                                                                               \
    , global const uint *leaf_starts, global const uint *offsets, global const float *positions,                      \
        global const uint *triangles, global Triangle4 *blocks, uint trees, uint first_leaf
#else
#define LEAF_PARAMETERS
#endif

/// Writes the wide nodes [first_node, first_node + level_size) of one level, and its triangle blocks from first_leaf
/// on. Inner children are numbered from first_node + level_size.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void write_level(global const Aabb* volumes, global const uint* far_ends, global const uint* order,
                 global const uint* kids, global const uint* inner_starts, global Wide8Node* nodes, uint count,
                 uint level_size, uint first_node LEAF_PARAMETERS) {
    const uint w = (uint)get_global_id(0);
    if (w >= level_size) return;
    global Wide8Node* node = nodes + first_node + w;
    uint inner = first_node + level_size + inner_starts[w];
#if TRIANGLE_LEAVES
    uint leaf = first_leaf + leaf_starts[w];
#endif
    uint found = 0;
    for (uint i = 0; i < 8; ++i) {
        const uint kid = kids[8 * (size_t)w + i];
        uint reference = BOXWOOD_NONE;
        Aabb box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
        if (kid != BOXWOOD_NONE) {
            ++found;
            box = volumes[kid & ~BOXWOOD_LEAF];
            const uint2 range = range_of(kid & ~BOXWOOD_LEAF, far_ends, count);
            if (!(kid & BOXWOOD_LEAF)) {
                reference = inner++;
            } else {
#if TRIANGLE_LEAVES
                const uint first_triangle = offsets[tree_of(offsets, trees, range.x)];
                write_block(blocks + leaf, range, order, positions, triangles, first_triangle);
                reference = BOXWOOD_LEAF | leaf++;
#else
                reference = BOXWOOD_LEAF | order[range.x];
#endif
            }
        }
        node->min_x[i] = box.min[0];
        node->max_x[i] = box.max[0];
        node->min_y[i] = box.min[1];
        node->max_y[i] = box.max[1];
        node->min_z[i] = box.min[2];
        node->max_z[i] = box.max[2];
        node->child[i] = reference;
    }
    node->count = found;
    for (int i = 0; i < 7; ++i) node->reserved[i] = 0;
}
