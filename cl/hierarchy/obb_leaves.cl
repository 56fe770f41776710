// SPDX-License-Identifier: MIT
// Oriented boxes, first part: the points of the primitives in sorted order, and the boxes and moments of the leaves.
//
// POINTS_PER_PRIMITIVE  see hierarchy/obb_node.h
// LANES, MEASURE_AREA, FALLBACK  see bounds/real.h and bounds/oriented_box.h
// compile: POINTS_PER_PRIMITIVE=3 LANES=8 MEASURE_AREA=0 FALLBACK=1
// compile: POINTS_PER_PRIMITIVE=3 LANES=1 MEASURE_AREA=1 FALLBACK=0
// compile: POINTS_PER_PRIMITIVE=8 LANES=8 MEASURE_AREA=0 FALLBACK=1
// compile: POINTS_PER_PRIMITIVE=8 LANES=1 MEASURE_AREA=0 FALLBACK=1
#include "hierarchy/obb_node.h"

#if POINTS_PER_PRIMITIVE == 3

/// points: the vertices of the triangles at the sorted positions of one slice, x, y and z apart.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void sorted_points(global const uint* order, global const float* positions, global const uint* triangles,
                   global float* points, uint stride, uint count, uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    if (begin >= count) return;
    const uint end = min(begin + slice, count);
    for (uint i = begin; i < end; ++i) {
        for (uint k = 0; k < 3; ++k) {
            global const float* vertex = positions + 3 * (size_t)triangles[3 * (size_t)order[i] + k];
            for (uint axis = 0; axis < 3; ++axis) points[axis * (size_t)stride + 3 * (size_t)i + k] = vertex[axis];
        }
    }
}

/// The smallest rectangle around a triangle has a side on its longest edge, and the box around that is flat.
INLINE void triangle_frame(const Vector* p, const Vector* q, const Vector* r, Frame* frame) {
    const Vector pq = {q->x - p->x, q->y - p->y, q->z - p->z};
    const Vector qr = {r->x - q->x, r->y - q->y, r->z - q->z};
    const Vector rp = {p->x - r->x, p->y - r->y, p->z - r->z};
    Vector longest = pq, other = qr;
    mask longer = dot3(&qr, &qr) > dot3(&longest, &longest);
    choose3(longer, &qr, &longest);
    choose3(longer, &rp, &other);
    longer = dot3(&rp, &rp) > dot3(&longest, &longest);
    choose3(longer, &rp, &longest);
    choose3(longer, &pq, &other);

    Frame identity;
    identity_frame(&identity);
    choose3(largest3(&longest) == 0.0f, &identity.a, &longest);
    normalise3(&longest);
    // Where the edges are parallel to rounding, any normal to the first will do: by way of the axis farthest from it.
    Vector normal, spare = identity.a;
    cross3(&longest, &other, &normal);
    choose3(fabs(longest.y) < fabs(longest.x), &identity.b, &spare);
    choose3((fabs(longest.z) < fabs(longest.x)) & (fabs(longest.z) < fabs(longest.y)), &identity.c, &spare);
    Vector across;
    cross3(&longest, &spare, &across);
    choose3(largest3(&normal) <= 8.0f * ROUNDOFF * largest3(&other), &across, &normal);
    scale3(inverse_power(power_below(largest3(&normal))), &normal);
    normalise3(&normal);
    frame->a = longest;
    cross3(&normal, &longest, &frame->b);
    orthonormalise(frame);
}

/// The boxes of the leaves at the sorted positions of one slice.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void triangle_leaves(global const Aabb* aabbs, global const float* coordinates, uint stride, global Obb* boxes,
                     uint count, uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    if (begin >= count) return;
    const uint end = min(begin + slice, count);
    const Nodes nodes = {aabbs, coordinates, stride, 0, count};
    for (uint first = begin; first < end; first += LANES) {
        uint leaf[LANES];
        for (uint lane = 0; lane < LANES; ++lane) leaf[lane] = count + min(first + lane, end - 1);
        Space space;
        Vector points[POINTS_PER_PRIMITIVE];
        space_of(aabbs, leaf, &space);
        load_primitives(&nodes, first, &space, points);
        Frame axes;
        triangle_frame(&points[0], &points[1], &points[2], &axes);
        Slabs slabs;
        empty_slabs(&slabs);
        for (int k = 0; k < 3; ++k) add_point(&axes, &points[k], &slabs);
        const Vector exact = {0.0f, 0.0f, 0.0f};
        finish_boxes(&space, &axes, &slabs, &exact, boxes, leaf, min((uint)LANES, end - first));
    }
}

#endif

/// moments of the leaves at the sorted positions of one slice.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void leaf_moments(global const Aabb* aabbs, global const float* coordinates, uint stride, global float* moments,
                  uint count, uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    if (begin >= count) return;
    const uint end = min(begin + slice, count);
    const Nodes nodes = {aabbs, coordinates, stride, 0, count};
    for (uint first = begin; first < end; first += LANES) {
        uint leaf[LANES];
        for (uint lane = 0; lane < LANES; ++lane) leaf[lane] = count + min(first + lane, end - 1);
        Space space;
        Vector points[POINTS_PER_PRIMITIVE];
        space_of(aabbs, leaf, &space);
        load_primitives(&nodes, first, &space, points);
        Moments found;
        primitive_moments(points, &found);
        store_moments(&found, moments, leaf, min((uint)LANES, end - first));
    }
}

/// The unused slot at the end of each tree gets the empty box.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void empty_boxes(global const uint* offsets, global Obb* boxes, uint trees) {
    const uint tree = (uint)get_global_id(0);
    if (tree >= trees) return;
    Obb empty;
    for (int k = 0; k < 3; ++k) {
        empty.center[k] = 0.0f;
        empty.extent[k] = -INFINITY;
    }
    for (int k = 0; k < 9; ++k) empty.axes[k] = k % 4 == 0 ? 1.0f : 0.0f;
    empty.aligned = 1;
    boxes[offsets[tree + 1] - 1] = empty;
}
