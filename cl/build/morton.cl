// SPDX-License-Identifier: MIT
// Morton codes of primitives (dissertation 3.3.1), with the tree they belong to above the code (3.6.1).
//
// KEY        type of a key: uint or ulong
// AXIS_BITS  bits per axis, 1..21
// TREE_IN_KEY     0: one tree, keys are codes; 1: the tree's index stands above the code
// compile: KEY=uint AXIS_BITS=10 TREE_IN_KEY=0
// compile: KEY=ulong AXIS_BITS=10 TREE_IN_KEY=1
// compile: KEY=ulong AXIS_BITS=21 TREE_IN_KEY=0
#include "runtime/numerics.h"
#include "bounds/box.h"
#include "primitives/segments.h"

#if !defined(KEY) || !defined(AXIS_BITS) || !defined(TREE_IN_KEY)
#error "define KEY, AXIS_BITS and TREE_IN_KEY"
#endif

/// Moves bit i of the AXIS_BITS low bits of each lane to bit 3 i, by halving distances.
#if AXIS_BITS <= 10
inline uint4 spread(uint4 x) {
    x = (x | (x << 16)) & 0x030000ffu;
    x = (x | (x << 8)) & 0x0300f00fu;
    x = (x | (x << 4)) & 0x030c30c3u;
    return (x | (x << 2)) & 0x09249249u;
}
#else
inline ulong4 spread(ulong4 x) {
    x = (x | (x << 32)) & 0x001f00000000fffful;
    x = (x | (x << 16)) & 0x001f0000ff0000fful;
    x = (x | (x << 8)) & 0x100f00f00f00f00ful;
    x = (x | (x << 4)) & 0x10c30c30c30c30c3ul;
    return (x | (x << 2)) & 0x1249249249249249ul;
}
#endif

/// Maps positions of one tree to cells: its lower corner, and cells per length in the cube of its largest extent (0 for
/// a point, so that all lands in cell 0). The product rounds alike at every power-of-two scale. Lane 3 is not used.
typedef struct Grid {
    float4 low;
    float zoom; ///< A power of two that makes the cube large enough for cells per length to be a float.
    float scale;
} Grid;

inline Grid grid_of(global const Aabb* bounds) {
    const Box box = load_box(bounds);
    const float3 extent = extent_of(box);
    const float side = max(max(extent.x, extent.y), extent.z);
    const float zoom = side < 0x1p-90f ? 0x1p90f : 1.0f;
    const Grid grid = {box.a, zoom, side > 0.0f ? (float)(1 << AXIS_BITS) / (side * zoom) : 0.0f};
    return grid;
}

inline KEY code(Box box, Grid grid) {
    // Halves of subnormal numbers round, so a centre may lie below the corner.
    const float4 place =
        clamp((box_centre(box) - grid.low) * grid.zoom * grid.scale, 0.0f, (float)((1 << AXIS_BITS) - 1));
#if AXIS_BITS <= 10
    const uint4 cells = spread(convert_uint4(place));
#else
    const ulong4 cells = spread(convert_ulong4(place));
#endif
    return ((KEY)cells.x << 2) | ((KEY)cells.y << 1) | (KEY)cells.z;
}

/// keys[i] and order[i] = i, the pairs to sort, for the primitives of one slice. Trees are not empty, so stepping to
/// the next tree is one step.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void morton_keys(global const Aabb* boxes, global const uint* offsets, global const Aabb* tree_bounds, global KEY* keys,
                 global uint* order, uint trees, uint count, uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    if (begin >= count) return;
    const uint end = min(begin + slice, count);
    uint tree = segment_of(offsets, trees, begin);
    uint tree_end = offsets[tree + 1];
    Grid grid = grid_of(tree_bounds + tree);
    for (uint i = begin; i < end; ++i) {
        if (i >= tree_end) {
            ++tree;
            tree_end = offsets[tree + 1];
            grid = grid_of(tree_bounds + tree);
        }
        order[i] = i;
#if TREE_IN_KEY
        keys[i] = code(load_box(boxes + i), grid) | ((KEY)tree << (3 * AXIS_BITS));
#else
        keys[i] = code(load_box(boxes + i), grid);
#endif
    }
}
