// SPDX-License-Identifier: MIT
// Oriented boxes in registers, LANES at a time: load, store, and what turns a fitted frame into a node's box: extents
// with a bound on their rounding, the centre, and the choice between that box and the node's AABB (dissertation 3.1.3
// and 3.5).
//
// Each node has a space of its own, p' = (p - origin) / unit, with the centre of its AABB as origin and a power of two
// near its size as unit: nothing overflows, what underflows is far below rounding, no digits are lost far from the
// world's origin, and a scene scaled by a power of two gives the same bits.
//
// MEASURE_AREA  0: the smaller volume is kept; 1: the smaller surface area
// FALLBACK      1: a node keeps its AABB where its oriented box is not smaller; 0: never
#ifndef BOXWOOD_BOUNDS_ORIENTED_BOX_H
#define BOXWOOD_BOUNDS_ORIENTED_BOX_H
#include "runtime/vector.h"
#include "shared/aabb.h"
#include "shared/obb.h"

#if !defined(MEASURE_AREA) || !defined(FALLBACK)
#error "define MEASURE_AREA (0 or 1) and FALLBACK (0 or 1)"
#endif

// Unit roundoff of float.
#define ROUNDOFF 0x1p-24f

typedef struct Space {
    Vector origin;
    real unit;
    real inverse_unit;
    Vector low, high; ///< The AABB, in the space.
    Vector reach;     ///< Its largest absolute coordinates, in the space.
} Space;

/// A box in some space.
typedef struct OrientedBox {
    Vector center;
    Vector extent;
    Frame axes;
} OrientedBox;

/// p' of a point; one rounding, that of the difference (the scaling by a power of two is exact).
INLINE void to_space(const Space* space, const Vector* p, Vector* result) {
    result->x = (p->x - space->origin.x) * space->inverse_unit;
    result->y = (p->y - space->origin.y) * space->inverse_unit;
    result->z = (p->z - space->origin.z) * space->inverse_unit;
}

/// The space of nodes with the AABBs of `index`. An empty AABB gives NaN; such nodes have no box to fit.
INLINE void space_of(global const Aabb* aabbs, const uint* index, Space* space) {
    real v[8];
    load_rows6((global const float*)aabbs, 6, index, v);
    const Vector low = {v[0], v[1], v[2]}, high = {v[3], v[4], v[5]};
    space->origin.x = 0.5f * low.x + 0.5f * high.x;
    space->origin.y = 0.5f * low.y + 0.5f * high.y;
    space->origin.z = 0.5f * low.z + 0.5f * high.z;
    const Vector extent = {high.x - low.x, high.y - low.y, high.z - low.z};
    // A box of no extent still needs 1 / unit times its coordinates to be finite. Any other extent is at least a unit
    // in the last place of a coordinate, so the second term does not count then.
    space->unit = power_below(larger(largest3(&extent), 0x1p-30f * largest3(&space->origin)));
    space->inverse_unit = inverse_power(space->unit);
    to_space(space, &low, &space->low);
    to_space(space, &high, &space->high);
    space->reach.x = larger(-space->low.x, space->high.x);
    space->reach.y = larger(-space->low.y, space->high.y);
    space->reach.z = larger(-space->low.z, space->high.z);
}

/// The boxes of nodes, in `space`.
INLINE void load_boxes(global const Obb* boxes, const uint* index, const Space* space, OrientedBox* box) {
    real v[8], w[8];
    load_rows8((global const float*)boxes, 16, index, v);
    load_rows8((global const float*)boxes + 8, 16, index, w);
    const Vector center = {v[0], v[1], v[2]}, extent = {v[3], v[4], v[5]};
    const Frame axes = {{v[6], v[7], w[0]}, {w[1], w[2], w[3]}, {w[4], w[5], w[6]}};
    to_space(space, &center, &box->center);
    box->extent = extent;
    scale3(space->inverse_unit, &box->extent);
    box->axes = axes;
}

/// The axes of nodes.
INLINE void load_frame(global const Obb* boxes, const uint* index, Frame* axes) {
    real v[8], w[8];
    load_rows8((global const float*)boxes, 16, index, v);
    load_rows8((global const float*)boxes + 8, 16, index, w);
    const Frame frame = {{v[6], v[7], w[0]}, {w[1], w[2], w[3]}, {w[4], w[5], w[6]}};
    *axes = frame;
}

/// Lower and upper ends of a set along the three axes of a frame, in a node's space.
typedef struct Slabs {
    Vector low, high;
} Slabs;

INLINE void empty_slabs(Slabs* slabs) {
    const real infinity = INFINITY;
    const Vector low = {infinity, infinity, infinity}, high = {-infinity, -infinity, -infinity};
    slabs->low = low;
    slabs->high = high;
}

INLINE void widen(real from, real to, real* low, real* high) {
    *low = smaller(from, *low);
    *high = larger(to, *high);
}

/// Takes a point in. Its rounding is left to half_width.
INLINE void add_point(const Frame* axes, const Vector* p, Slabs* slabs) {
    const real a = dot3(&axes->a, p), b = dot3(&axes->b, p), c = dot3(&axes->c, p);
    widen(a, a, &slabs->low.x, &slabs->high.x);
    widen(b, b, &slabs->low.y, &slabs->high.y);
    widen(c, c, &slabs->low.z, &slabs->high.z);
}

/// Takes in the 8 corners of an orthonormal box, center +- extent[k] axis[k]: along an axis they reach
/// sum extent[k] |axis . axis[k]| to either side. What that lacks to the true box is below 64 roundoffs of
/// |axis| . |center| + sum extent[k]: 4 for the dot products, 4 for the sums, and for the box's edges, which are the
/// columns of the inverse of its axes and not exactly their rows, 42 (24 in each of three entries, see orthonormalise).
INLINE void add_box_along(const Vector* axis, const OrientedBox* box, real* low, real* high) {
    const real middle = dot3(axis, &box->center);
    const real a = fabs(dot3(axis, &box->axes.a)), b = fabs(dot3(axis, &box->axes.b)),
               c = fabs(dot3(axis, &box->axes.c));
    const real reach = fma(box->extent.x, a, fma(box->extent.y, b, box->extent.z * c));
    const real size = reach3(axis, &box->center) + box->extent.x + box->extent.y + box->extent.z;
    const real padded = fma(64.0f * ROUNDOFF, size, reach);
    widen(middle - padded, middle + padded, low, high);
}

/// The same with an AABB, which is exact: whichever of the two boxes around one set reaches less far counts.
INLINE void add_boxes_along(const Vector* axis, const OrientedBox* box, const Vector* middle, const Vector* reach,
                            real* low, real* high) {
    real from = INFINITY, to = -INFINITY;
    add_box_along(axis, box, &from, &to);
    const real center = dot3(axis, middle), half_way = reach3(axis, reach);
    const real padded = fma(16.0f * ROUNDOFF, reach3(axis, middle) + half_way, half_way);
    widen(larger(from, center - padded), smaller(to, center + padded), low, high);
}

/// Takes in a set that lies in both an oriented box and an AABB (`own`, the space of the AABB's node).
INLINE void add_boxes(const Frame* axes, const OrientedBox* box, const Space* own, const Space* space, Slabs* slabs) {
    Vector middle, reach = own->reach;
    to_space(space, &own->origin, &middle);
    scale3(own->unit * space->inverse_unit, &reach);
    add_boxes_along(&axes->a, box, &middle, &reach, &slabs->low.x, &slabs->high.x);
    add_boxes_along(&axes->b, box, &middle, &reach, &slabs->low.y, &slabs->high.y);
    add_boxes_along(&axes->c, box, &middle, &reach, &slabs->low.z, &slabs->high.z);
}

INLINE void add_box(const Frame* axes, const OrientedBox* box, Slabs* slabs) {
    add_box_along(&axes->a, box, &slabs->low.x, &slabs->high.x);
    add_box_along(&axes->b, box, &slabs->low.y, &slabs->high.y);
    add_box_along(&axes->c, box, &slabs->low.z, &slabs->high.z);
}

/// Half a width about the projection of the stored centre, and the bound on its rounding. `reach` bounds the
/// coordinates of the points in the space, `center` is the stored centre there, `inexact` the error that the points had
/// before.
///
/// The projection of a point takes 4 roundoffs of |axis| . reach (one of the difference from the origin, three of the
/// products and sums), that of the centre 4 of |axis| . |center|, the two differences below one each of their sum: 6 of
/// it in all, 8 with the rounding of the bound itself.
INLINE real half_width(const Vector* axis, real low, real high, const Vector* reach, const Vector* center,
                       const Vector* inexact) {
    const real middle = dot3(axis, center);
    const real size = reach3(axis, reach) + reach3(axis, center);
    // Products and sums below 2^-126 round to multiples of 2^-149: of at most 8 of them half of one is lost each.
    const real error = fma(8.0f * ROUNDOFF, size, reach3(axis, inexact)) + 0x1p-146f;
    return fma(larger(high - middle, middle - low), (real)(1.0f + 2.0f * ROUNDOFF), error);
}

INLINE real measure_of(const Vector* extent) {
#if MEASURE_AREA
    return fma(extent->x, extent->y, fma(extent->y, extent->z, extent->z * extent->x));
#else
    return extent->x * extent->y * extent->z;
#endif
}

/// Stores one box per lane; `count` lanes are in use.
INLINE void store_boxes(const OrientedBox* box, mask aligned, global Obb* boxes, const uint* index, uint count) {
    const real one = AS_REAL(CHOOSE_INT(aligned, 1, 0));
    real v[8] = {box->center.x, box->center.y, box->center.z, box->extent.x,
                 box->extent.y, box->extent.z, box->axes.a.x, box->axes.a.y};
    real w[8] = {box->axes.a.z, box->axes.b.x, box->axes.b.y, box->axes.b.z,
                 box->axes.c.x, box->axes.c.y, box->axes.c.z, one};
    store_rows8(v, (global float*)boxes, 16, index, count);
    store_rows8(w, (global float*)boxes + 8, 16, index, count);
}

/// Stores the axes of nodes whose box is finished later.
INLINE void store_frame(const Frame* axes, global Obb* boxes, const uint* index, uint count) {
    const Vector none = {0.0f, 0.0f, 0.0f};
    const OrientedBox box = {none, none, *axes};
    store_boxes(&box, none.x != none.x, boxes, index, count);
}

/// From a frame and the slabs of all that lies below to the node's box, stored: the centre rounded to float, the widths
/// about what was stored. `inexact` as in half_width.
INLINE void finish_boxes(const Space* space, const Frame* axes, const Slabs* slabs, const Vector* inexact,
                         global Obb* boxes, const uint* index, uint count) {
    OrientedBox box;
    box.axes = *axes;
    Vector center = {0.0f, 0.0f, 0.0f};
    add_scaled3(0.5f * (slabs->low.x + slabs->high.x), &axes->a, &center);
    add_scaled3(0.5f * (slabs->low.y + slabs->high.y), &axes->b, &center);
    add_scaled3(0.5f * (slabs->low.z + slabs->high.z), &axes->c, &center);
    box.center.x = fma(center.x, space->unit, space->origin.x);
    box.center.y = fma(center.y, space->unit, space->origin.y);
    box.center.z = fma(center.z, space->unit, space->origin.z);
    to_space(space, &box.center, &center);
    box.extent.x = half_width(&axes->a, slabs->low.x, slabs->high.x, &space->reach, &center, inexact);
    box.extent.y = half_width(&axes->b, slabs->low.y, slabs->high.y, &space->reach, &center, inexact);
    box.extent.z = half_width(&axes->c, slabs->low.z, slabs->high.z, &space->reach, &center, inexact);
    mask aligned = AS_INT(box.extent.x) != AS_INT(box.extent.x);
#if FALLBACK
    const Vector straight = {0.5f * (space->high.x - space->low.x), 0.5f * (space->high.y - space->low.y),
                             0.5f * (space->high.z - space->low.z)};
    aligned = measure_of(&straight) <= measure_of(&box.extent);
    // About the origin, with the roundings of the two differences in to_space and of `reach` times the unit.
    choose3(aligned, &space->origin, &box.center);
    Vector wide = space->reach;
    scale3((real)(1.0f + 4.0f * ROUNDOFF), &wide);
    choose3(aligned, &wide, &box.extent);
    Frame identity;
    identity_frame(&identity);
    choose3(aligned, &identity.a, &box.axes.a);
    choose3(aligned, &identity.b, &box.axes.b);
    choose3(aligned, &identity.c, &box.axes.c);
#endif
    // Rounding to denormals is absolute: at most half the smallest one, which is added whole.
    box.extent.x = fma(box.extent.x, space->unit, (real)(0x1p-149f));
    box.extent.y = fma(box.extent.y, space->unit, (real)(0x1p-149f));
    box.extent.z = fma(box.extent.z, space->unit, (real)(0x1p-149f));
    store_boxes(&box, aligned, boxes, index, count);
}

#endif
