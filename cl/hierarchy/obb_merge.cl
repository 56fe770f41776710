// SPDX-License-Identifier: MIT
// Oriented boxes, second part: the nodes of one level of the tree, each from its two children (dissertation 3.5). Levels
// are by height: all nodes whose children are done, LANES at a time.
//
// MERGE    0: moments of all points below; 1: PCA over the 16 corners of the children's boxes ("bounded")
// EXTENTS  1: the box is made here, from the children's boxes; 0: only its axes, the extents come from obb_ranges.cl
// POINTS_PER_PRIMITIVE, LANES, MEASURE_AREA, FALLBACK  see hierarchy/obb_node.h, bounds/real.h, bounds/oriented_box.h
// compile: MERGE=0 EXTENTS=0 POINTS_PER_PRIMITIVE=3 LANES=8 MEASURE_AREA=0 FALLBACK=1
// compile: MERGE=0 EXTENTS=1 POINTS_PER_PRIMITIVE=3 LANES=1 MEASURE_AREA=0 FALLBACK=1
// compile: MERGE=1 EXTENTS=1 POINTS_PER_PRIMITIVE=3 LANES=8 MEASURE_AREA=1 FALLBACK=0
// compile: MERGE=1 EXTENTS=1 POINTS_PER_PRIMITIVE=8 LANES=1 MEASURE_AREA=0 FALLBACK=1
#include "bounds/eigen.h"
#include "runtime/prefetch.h"
#include "hierarchy/obb_node.h"

#if MERGE == 0

/// Share of the weight that the second child has.
INLINE real second_share(const uint* first, const uint* second, global const uint* far_ends, uint count) {
    float share[LANES];
    for (uint lane = 0; lane < LANES; ++lane) {
        const float a = first[lane] < count ? range_size(first[lane], far_ends) : 1;
        const float b = second[lane] < count ? range_size(second[lane], far_ends) : 1;
        share[lane] = b / (a + b);
    }
    return LOAD_LANES(share);
}

/// The moments of the children's points, merged in the parent's space.
INLINE void merge_children(global const Aabb* aabbs, const Space* space, const uint* first, const uint* second, real share,
                           global const float* moments, Moments* merged) {
    Space below;
    Moments other;
    load_moments(moments, first, merged);
    space_of(aabbs, first, &below);
    change_space(&below, space, merged);
    load_moments(moments, second, &other);
    space_of(aabbs, second, &below);
    change_space(&below, space, &other);
    merge_moments(share, &other, merged);
}

#endif

/// The nodes level[first .. first + level_count - 1].
/// Before: boxes (and moments) of all nodes of lower levels are done. After: those of these nodes.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void merge_level(global const uint* level, uint level_first, uint level_count, uint slice,
                 global const uint2* children, global const uint* far_ends, global const Aabb* aabbs,
                 global float* moments, global Obb* boxes, uint count) {
    const uint begin = (uint)get_global_id(0) * slice;
    if (begin >= level_count) return;
    const uint end = min(begin + slice, level_count);
    for (uint i = begin; i < end; i += LANES) {
        uint index[LANES], first[LANES], second[LANES];
        for (uint lane = 0; lane < LANES; ++lane) {
            index[lane] = level[level_first + min(i + lane, end - 1)];
            const uint2 below = children[index[lane]];
            first[lane] = below.x;
            second[lane] = below.y;
        }
        const uint used = min((uint)LANES, end - i);
        for (uint next = i + LANES; next < min(i + 2 * LANES, end); ++next) {
            const uint2 below = children[level[level_first + next]];
            prefetch_256((global const char*)&boxes[below.x]);
            prefetch_256((global const char*)&boxes[below.y]);
        }
        Space space;
        space_of(aabbs, index, &space);
        Moments merged;
#if MERGE == 0
        merge_children(aabbs, &space, first, second, second_share(first, second, far_ends, count), moments, &merged);
        store_moments(&merged, moments, index, used);
#endif
#if MERGE != 0 || EXTENTS
        OrientedBox a, b;
        load_boxes(boxes, first, &space, &a);
        load_boxes(boxes, second, &space, &b);
#endif
#if MERGE == 1
        Moments other;
        box_moments(&a, &merged);
        box_moments(&b, &other);
        merge_moments((real)(0.5f), &other, &merged);
#endif
        Frame axes;
        eigenvectors(&merged.covariance, &axes);
#if EXTENTS
        Slabs slabs;
        empty_slabs(&slabs);
        add_box(&axes, &a, &slabs);
        add_box(&axes, &b, &slabs);
        const Vector exact = {0.0f, 0.0f, 0.0f};
        finish_boxes(&space, &axes, &slabs, &exact, boxes, index, used);
#else
        store_frame(&axes, boxes, index, used);
#endif
    }
}
