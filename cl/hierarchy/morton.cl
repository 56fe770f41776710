// SPDX-License-Identifier: MIT
// Morton codes of primitives (dissertation 3.3.1), with the tree they belong to above the code (3.6.1).
//
// KEY        type of a key: uint or ulong
// AXIS_BITS  bits per axis, 1..21
// FOREST     0: one tree, keys are codes; 1: the tree's index stands above the code
// compile: KEY=uint AXIS_BITS=10 FOREST=0
// compile: KEY=ulong AXIS_BITS=10 FOREST=1
// compile: KEY=ulong AXIS_BITS=21 FOREST=0
#include "runtime/numerics.h"
#include "hierarchy/forest.h"
#include "shared/aabb.h"

#if !defined(KEY) || !defined(AXIS_BITS) || !defined(FOREST)
#error "define KEY, AXIS_BITS and FOREST"
#endif

/// Moves bit i of the AXIS_BITS low bits of `x` to bit 3 i, by halving distances.
#if AXIS_BITS <= 10
inline KEY spread(uint bits) {
    KEY x = bits;
    x = (x | (x << 16)) & 0x030000ffu;
    x = (x | (x << 8)) & 0x0300f00fu;
    x = (x | (x << 4)) & 0x030c30c3u;
    x = (x | (x << 2)) & 0x09249249u;
    return x;
}
#else
inline KEY spread(uint bits) {
    KEY x = bits;
    x = (x | (x << 32)) & 0x001f00000000fffful;
    x = (x | (x << 16)) & 0x001f0000ff0000fful;
    x = (x | (x << 8)) & 0x100f00f00f00f00ful;
    x = (x | (x << 4)) & 0x10c30c30c30c30c3ul;
    x = (x | (x << 2)) & 0x1249249249249249ul;
    return x;
}
#endif

/// Cell of `center` along one axis of the cube [low, low + side]; cell 0 when the cube is a point.
inline uint cell(float center, float low, float side) {
    const float cells = (float)(1 << AXIS_BITS);
    const float position = side > 0.0f ? (center - low) / side : 0.0f;
    return min((uint)(position * cells), (1u << AXIS_BITS) - 1u);
}

inline KEY code(Aabb box, Aabb bounds) {
    const float side = max(max(bounds.max[0] - bounds.min[0], bounds.max[1] - bounds.min[1]),
                           bounds.max[2] - bounds.min[2]);
    const KEY x = spread(cell(0.5f * box.min[0] + 0.5f * box.max[0], bounds.min[0], side));
    const KEY y = spread(cell(0.5f * box.min[1] + 0.5f * box.max[1], bounds.min[1], side));
    const KEY z = spread(cell(0.5f * box.min[2] + 0.5f * box.max[2], bounds.min[2], side));
    return (x << 2) | (y << 1) | z;
}

/// keys[i] and order[i] = i, the pairs to sort, for the primitives of one slice. Trees are not empty, so stepping to the next tree is one step.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void morton_keys(global const Aabb* boxes, global const uint* offsets, global const Aabb* tree_bounds,
                 global KEY* keys, global uint* order, uint trees, uint count, uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    if (begin >= count) return;
    const uint end = min(begin + slice, count);
    uint tree = tree_of(offsets, trees, begin);
    uint tree_end = offsets[tree + 1];
    Aabb bounds = tree_bounds[tree];
    for (uint i = begin; i < end; ++i) {
        if (i >= tree_end) {
            ++tree;
            tree_end = offsets[tree + 1];
            bounds = tree_bounds[tree];
        }
        order[i] = i;
#if FOREST
        keys[i] = code(boxes[i], bounds) | ((KEY)tree << (3 * AXIS_BITS));
#else
        keys[i] = code(boxes[i], bounds);
#endif
    }
}
