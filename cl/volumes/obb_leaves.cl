// SPDX-License-Identifier: MIT
// Oriented boxes, first part: the leaves of trees over triangles (those over instances: obb_instances.cl).
//
// SORTED_POINTS         1: the vertices are written in sorted order, x, y and z apart, for kinds that pass over them
// MOMENTS               1: the moments of the vertices are written
// POINTS_PER_PRIMITIVE  3, see volumes/obb_node.h
// LANES, MEASURE_AREA, FALLBACK  see runtime/real.h and bounds/oriented_box.h
// compile: SORTED_POINTS=1 MOMENTS=1 POINTS_PER_PRIMITIVE=3 LANES=8 MEASURE_AREA=0 FALLBACK=1
// compile: SORTED_POINTS=0 MOMENTS=0 POINTS_PER_PRIMITIVE=3 LANES=1 MEASURE_AREA=1 FALLBACK=0
#include "volumes/obb_node.h"

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

/// Vertex k of a triangle.
INLINE global const float* corner_of(global const float* positions, global const uint* triangles, uint triangle,
                                     uint k) {
    return positions + 3 * (size_t)triangles[3 * (size_t)triangle + k];
}

/// The leaves at the sorted positions of one slice: their boxes; with SORTED_POINTS their `points`, see Nodes, and with
/// MOMENTS their `moments`, BOXWOOD_MOMENT_FLOATS per node, which may be null otherwise.
/// Before: aabbs of the leaves.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void triangle_leaves(global const uint* order, global const float* positions, global const uint* triangles,
                     global const Aabb* aabbs, global float* points, uint stride, global float* moments,
                     global Obb* boxes, uint count, uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    if (begin >= count) return;
    const uint end = min(begin + slice, count);
    for (uint first = begin; first < end; first += LANES) {
        uint leaf[LANES];
        float corner[9][LANES];
        const uint used = min((uint)LANES, end - first);
        for (uint lane = 0; lane < LANES; ++lane) {
            const uint position = min(first + lane, end - 1);
            leaf[lane] = count + position;
            for (uint k = 0; k < 3; ++k) {
                global const float* vertex = corner_of(positions, triangles, order[position], k);
                for (uint axis = 0; axis < 3; ++axis) corner[3 * k + axis][lane] = vertex[axis];
            }
        }
#if SORTED_POINTS
        for (uint axis = 0; axis < 3; ++axis)
            for (uint lane = 0; lane < used; ++lane)
                for (uint k = 0; k < 3; ++k)
                    points[axis * (size_t)stride + 3 * (size_t)(first + lane) + k] = corner[3 * k + axis][lane];
#endif
        Space space;
        Vector p[3];
        space_of(aabbs, leaf, &space);
        for (uint k = 0; k < 3; ++k) {
            const Vector world = {LOAD_LANES(corner[3 * k]), LOAD_LANES(corner[3 * k + 1]),
                                  LOAD_LANES(corner[3 * k + 2])};
            to_space(&space, &world, &p[k]);
        }
#if MOMENTS
        Moments found;
        primitive_moments(p, &found);
        store_moments(&found, moments, leaf, used);
#endif
        Frame axes;
        triangle_frame(&p[0], &p[1], &p[2], &axes);
        Slabs slabs;
        empty_slabs(&slabs);
        for (int k = 0; k < 3; ++k) add_point(&axes, &p[k], &slabs);
        Vector error;
        hit_error(&error);
        finish_boxes(&space, &axes, &slabs, &error, boxes, leaf, used);
    }
}
