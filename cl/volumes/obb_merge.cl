// SPDX-License-Identifier: MIT
// Oriented boxes, second part: the nodes of one level of the tree, each from its two children (dissertation 3.5).
// Levels are by height: all nodes whose children are done, LANES at a time.
//
// MERGE    0: moments of all points below; 1: PCA over the 16 corners of the children's boxes ("bounded"); 2: half-way
//          rotation of the children's boxes; 3: the cascade: points where both children are leaves, corners and points
//          where one is, else as 2
// EXTENTS  1: the box is made here, from the children's boxes; 0: only its axes, the extents come from obb_ranges.cl
// POINTS_PER_PRIMITIVE, LANES, MEASURE_AREA, FALLBACK  see volumes/obb_node.h, runtime/real.h, bounds/oriented_box.h
// compile: MERGE=0 EXTENTS=0 POINTS_PER_PRIMITIVE=3 LANES=8 MEASURE_AREA=0 FALLBACK=1
// compile: MERGE=0 EXTENTS=1 POINTS_PER_PRIMITIVE=3 LANES=1 MEASURE_AREA=0 FALLBACK=1
// compile: MERGE=1 EXTENTS=1 POINTS_PER_PRIMITIVE=3 LANES=8 MEASURE_AREA=1 FALLBACK=0
// compile: MERGE=2 EXTENTS=1 POINTS_PER_PRIMITIVE=3 LANES=8 MEASURE_AREA=0 FALLBACK=1
// compile: MERGE=3 EXTENTS=1 POINTS_PER_PRIMITIVE=3 LANES=8 MEASURE_AREA=0 FALLBACK=1
// compile: MERGE=3 EXTENTS=1 POINTS_PER_PRIMITIVE=8 LANES=1 MEASURE_AREA=0 FALLBACK=1
// compile: MERGE=1 EXTENTS=1 POINTS_PER_PRIMITIVE=8 LANES=1 MEASURE_AREA=0 FALLBACK=1
// Two sweeps cost 0.06 % of the sum of volumes at the most (dragon), and save a tenth of the time.
#define JACOBI_SWEEPS 2
#include "bounds/eigen.h"
#include "bounds/rotation.h"
#include "runtime/prefetch.h"
#include "volumes/obb_node.h"

#if MERGE == 0

/// Share of the weight that the second child has.
INLINE real second_share(const uint* first, const uint* second, global const uint* far_ends, uint count) {
    float share[LANES];
    for (uint lane = 0; lane < LANES; ++lane) {
        const float a = node_size(first[lane], far_ends, count), b = node_size(second[lane], far_ends, count);
        share[lane] = b / (a + b);
    }
    return LOAD_LANES(share);
}

/// The moments of the children's points, merged in the parent's space.
INLINE void merge_children(global const Aabb* aabbs, const Space* space, const uint* first, const uint* second,
                           real share, global const float* moments, Space* first_space, Space* second_space,
                           Moments* merged) {
    Moments other;
    load_moments(moments, first, merged);
    space_of(aabbs, first, first_space);
    change_space(first_space, space, merged);
    load_moments(moments, second, &other);
    space_of(aabbs, second, second_space);
    change_space(second_space, space, &other);
    merge_moments(share, &other, merged);
}

#endif

#if MERGE == 1

/// Axes of the 16 corners of two boxes.
INLINE void axes_of_corners(const OrientedBox* a, const OrientedBox* b, Frame* axes) {
    Moments merged, other;
    box_moments(a, &merged);
    box_moments(b, &other);
    merge_moments((real)(0.5f), &other, &merged);
    eigenvectors(&merged.covariance, axes);
}

#endif
#if MERGE == 3

/// A child of the cascade: a box, or in the lanes of `leaf` the points of a primitive.
typedef struct Child {
    OrientedBox box;
    Vector points[POINTS_PER_PRIMITIVE];
    mask leaf;
} Child;

INLINE void load_child(const Nodes* nodes, global const Obb* boxes, const uint* index, const Space* space,
                       Child* child) {
    uint position[LANES];
    int is_leaf[LANES];
    for (uint lane = 0; lane < LANES; ++lane) {
        is_leaf[lane] = index[lane] >= nodes->count ? 1 : 0;
        // Not ?:, which becomes llvm.usub.sat: Oclgrind 21.10 does not know it.
        position[lane] = select(0u, index[lane] - nodes->count, (uint)is_leaf[lane]);
    }
    child->leaf = LOAD_LANES(is_leaf) != 0;
    load_boxes(boxes, index, space, &child->box);
    load_primitives_at(nodes, position, space, child->points);
}

INLINE void child_moments(const Child* child, Moments* moments, real* weight) {
    Moments of_points;
    box_moments(&child->box, moments);
    primitive_moments(child->points, &of_points);
    choose3(child->leaf, &of_points.mean, &moments->mean);
    choose6(child->leaf, &of_points.covariance, &moments->covariance);
    *weight = CHOOSE(child->leaf, (real)(POINTS_PER_PRIMITIVE), (real)(8.0f));
}

INLINE void add_child(const Frame* axes, const Child* child, Slabs* slabs) {
    Slabs of_box, of_points;
    empty_slabs(&of_box);
    empty_slabs(&of_points);
    add_box(axes, &child->box, &of_box);
    for (uint k = 0; k < POINTS_PER_PRIMITIVE; ++k) add_point(axes, &child->points[k], &of_points);
    choose3(child->leaf, &of_points.low, &of_box.low);
    choose3(child->leaf, &of_points.high, &of_box.high);
    widen(of_box.low.x, of_box.high.x, &slabs->low.x, &slabs->high.x);
    widen(of_box.low.y, of_box.high.y, &slabs->low.y, &slabs->high.y);
    widen(of_box.low.z, of_box.high.z, &slabs->low.z, &slabs->high.z);
}

/// Lanes are free to differ; what no lane needs is not computed.
INLINE void cascade_axes(const Child* a, const Child* b, Frame* axes) {
    const mask by_points = (a->leaf | b->leaf) != 0, by_boxes = (a->leaf | b->leaf) == 0;
    identity_frame(axes);
    if (ANY(by_points)) {
        Moments merged, other;
        real weight, other_weight;
        child_moments(a, &merged, &weight);
        child_moments(b, &other, &other_weight);
        merge_moments(other_weight / (weight + other_weight), &other, &merged);
        eigenvectors(&merged.covariance, axes);
    }
    if (ANY(by_boxes)) {
        Frame blended;
        blend_frames(&a->box.axes, &b->box.axes, &blended);
        orthonormalise(&blended);
        choose3(by_boxes, &blended.a, &axes->a);
        choose3(by_boxes, &blended.b, &axes->b);
        choose3(by_boxes, &blended.c, &axes->c);
    }
}

#endif

/// The nodes level[first .. first + level_count - 1].
/// Before: aabbs of all nodes, boxes (MERGE 0: and moments) of all nodes of lower levels. After: those of these nodes.
/// `points`, see Nodes, are read for MERGE 3, `errors` for 8 points, `moments` are read and written for MERGE 0; each
/// may be null otherwise.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void merge_level(global const uint* level, uint level_first, uint level_count, uint slice, global const uint2* children,
                 global const uint* far_ends, global const Aabb* aabbs, global const float* points, uint stride,
                 global const float* errors, global float* moments, global Obb* boxes, uint count) {
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
            prefetch_line((global const char*)&boxes[below.x]);
            prefetch_line((global const char*)&boxes[below.y]);
        }
        Space space;
        space_of(aabbs, index, &space);
        Frame axes;
#if MERGE == 0
        Moments merged;
        Space first_space, second_space;
        merge_children(aabbs, &space, first, second, second_share(first, second, far_ends, count), moments,
                       &first_space, &second_space, &merged);
        store_moments(&merged, moments, index, used);
        eigenvectors(&merged.covariance, &axes);
#endif
#if EXTENTS
        Slabs slabs;
        empty_slabs(&slabs);
#if MERGE == 3
        const Nodes nodes = {aabbs, points, stride, errors, count};
        Child a, b;
        load_child(&nodes, boxes, first, &space, &a);
        load_child(&nodes, boxes, second, &space, &b);
        cascade_axes(&a, &b, &axes);
        add_child(&axes, &a, &slabs);
        add_child(&axes, &b, &slabs);
        Vector inexact;
        inexact_of(&nodes, index, &space, &inexact);
#else
        OrientedBox a, b;
        load_boxes(boxes, first, &space, &a);
        load_boxes(boxes, second, &space, &b);
#if MERGE == 1
        axes_of_corners(&a, &b, &axes);
#elif MERGE == 2
        blend_frames(&a.axes, &b.axes, &axes);
        orthonormalise(&axes);
#endif
#if MERGE == 0
        add_boxes(&axes, &a, &first_space, &space, &slabs);
        add_boxes(&axes, &b, &second_space, &space, &slabs);
#else
        add_box(&axes, &a, &slabs);
        add_box(&axes, &b, &slabs);
#endif
        const Vector inexact = {0.0f, 0.0f, 0.0f}; // the boxes below hold what theirs was
#endif
        finish_boxes(&space, &axes, &slabs, &inexact, boxes, index, used);
#else
        store_frame(&axes, boxes, index, used);
#endif
    }
}
