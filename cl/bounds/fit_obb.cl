// SPDX-License-Identifier: MIT
// Oriented boxes of segments of points or triangles by principal component analysis (dissertation 3.1.3; Gottschalk
// 2000; for triangles continuous over the surface, as there). These kernels run between segmented reductions: one
// writes a value per element, the reduction combines those of each segment, and the next kernel starts from the result.
//
// Computations for a segment are in the space of its AABB (bounds/oriented_box.h). Second moments are taken about the
// mean, in a pass after the one that finds it, so that nothing cancels wherever the mean lies.
//
// GROUP_SIZE  work-items per group, 1 or more
// CORNERS     vertices per element: 1 for points, 3 for triangles
// LANES, MEASURE_AREA, FALLBACK   as in the headers; 1, 1 and 0 here
// compile: CORNERS=1 LANES=1 MEASURE_AREA=1 FALLBACK=0
// compile: CORNERS=3 LANES=1 MEASURE_AREA=1 FALLBACK=0
#ifndef GROUP_SIZE
#error "define GROUP_SIZE"
#endif
#if CORNERS != 1 && CORNERS != 3
#error "define CORNERS (1 or 3)"
#endif
#include "bounds/oriented_box.h"
#include "bounds/segment.h"

/// boxes[i] = AABB of element i.
/// @pre  `positions` holds 3 floats per vertex, `triangles` CORNERS indices per element (not read for points). Slices
///       of `length` elements, `slices` of them; so in all kernels over elements.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void element_boxes(global const float* positions, global const uint* triangles, global Aabb* boxes, uint count,
                   uint length, uint slices) {
    const uint slice = (uint)get_global_id(0);
    if (slice >= slices) return;
    const uint first = slice * length, last = first + min(length, count - first);
    for (uint i = first; i < last; ++i) {
        Vector corners[CORNERS];
        load_element(positions, triangles, i, corners);
        Slabs slabs = {corners[0], corners[0]};
        for (int k = 1; k < CORNERS; ++k) {
            widen(corners[k].x, corners[k].x, &slabs.low.x, &slabs.high.x);
            widen(corners[k].y, corners[k].y, &slabs.low.y, &slabs.high.y);
            widen(corners[k].z, corners[k].z, &slabs.low.z, &slabs.high.z);
        }
        store_slabs(&slabs, boxes + i);
    }
}

/// first[i] = (weight times centroid, weight) of element i in its segment's space. A point weighs 1. A triangle weighs
/// its area and, in units of its mesh's size squared, 2^-40: that decides where a mesh has no area, and is below the
/// rounding of any other.
/// @pre  `offsets` has segments + 1 ascending entries, aabbs[s] is the AABB of segment s; so below. Elements of no
///       segment are not written.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void first_moments(global const float* positions, global const uint* triangles, global const uint* offsets,
                   global const Aabb* aabbs, global float* first_moment, uint count, uint segments, uint length,
                   uint slices) {
    const uint slice = (uint)get_global_id(0);
    if (slice >= slices) return;
    uint first = slice * length;
    const uint last = first + min(length, count - first);
    for (uint s = segment_ending_after(offsets, segments, first); s < segments && first < last; ++s) {
        const uint end = min(offsets[s + 1], last);
        first = max(first, offsets[s]);
        Space space;
        space_of(aabbs, &s, &space);
        for (; first < end; ++first) {
            Vector corners[CORNERS], centroid;
            load_element_in(positions, triangles, first, &space, corners);
            const float weight = weigh_element(corners, &centroid);
            vstore4((float4)(weight * centroid.x, weight * centroid.y, weight * centroid.z, weight), first,
                    first_moment);
        }
    }
}

/// Second moments of element i about the mean of its segment, as xx, yy, zz, xy in diagonal[i] and xz, yz in rest[i].
/// For a triangle of area A with corners p_k and centroid m, the integral over it is
/// A (m - mean)(m - mean)^T + A/12 sum (p_k - m)(p_k - m)^T.
/// @pre  first_moment[s] is the sum over segment s.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void second_moments(global const float* positions, global const uint* triangles, global const uint* offsets,
                    global const Aabb* aabbs, global const float* first_moment, global float* diagonal,
                    global float* rest, uint count, uint segments, uint length, uint slices) {
    const uint slice = (uint)get_global_id(0);
    if (slice >= slices) return;
    uint first = slice * length;
    const uint last = first + min(length, count - first);
    for (uint s = segment_ending_after(offsets, segments, first); s < segments && first < last; ++s) {
        const uint end = min(offsets[s + 1], last);
        first = max(first, offsets[s]);
        Space space;
        space_of(aabbs, &s, &space);
        const float4 sum = vload4(s, first_moment);
        const Vector mean = {sum.x / sum.w, sum.y / sum.w, sum.z / sum.w};
        for (; first < end; ++first) {
            Vector corners[CORNERS], centroid;
            load_element_in(positions, triangles, first, &space, corners);
            const float weight = weigh_element(corners, &centroid);
            Symmetric m = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
            const Vector between = {centroid.x - mean.x, centroid.y - mean.y, centroid.z - mean.z};
            add_outer(weight, &between, &m);
            for (int k = 0; k < CORNERS; ++k) {
                const Vector spoke = {corners[k].x - centroid.x, corners[k].y - centroid.y, corners[k].z - centroid.z};
                add_outer(weight * (1.0f / 12.0f), &spoke, &m);
            }
            vstore4((float4)(m.xx, m.yy, m.zz, m.xy), first, diagonal);
            vstore4((float4)(m.xz, m.yz, 0.0f, 0.0f), first, rest);
        }
    }
}

/// The axes of boxes[s] become the eigenvectors of the second moments of segment s. close[s]: 1 when two eigenvalues
/// are so close that the sampling of a shape more than the shape decides between its axes; 0 otherwise.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void principal_axes(global const uint* offsets, global const float* diagonal, global const float* rest,
                    global Obb* boxes, global uint* close, uint segments, uint length, uint slices) {
    const uint slice = (uint)get_global_id(0);
    if (slice >= slices) return;
    const uint first = slice * length, last = first + min(length, segments - first);
    for (uint s = first; s < last; ++s) {
        const float4 a = vload4(s, diagonal), b = vload4(s, rest);
        const Symmetric m = {a.x, a.y, a.z, a.w, b.x, b.y};
        Frame axes;
        eigenvectors(&m, &axes);
        store_frame(&axes, boxes, &s, 1);
        const float p = along(&m, &axes.a), q = along(&m, &axes.b), r = along(&m, &axes.c);
        close[s] = offsets[s] < offsets[s + 1] && (p - q <= CLOSE * p || q - r <= CLOSE * q) ? 1 : 0;
    }
}

/// slabs[i] = ends of element i along the axes of boxes[s], s its segment, as an Aabb.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void element_slabs(global const float* positions, global const uint* triangles, global const uint* offsets,
                   global const Aabb* aabbs, global const Obb* boxes, global Aabb* slabs, uint count, uint segments,
                   uint length, uint slices) {
    const uint slice = (uint)get_global_id(0);
    if (slice >= slices) return;
    uint first = slice * length;
    const uint last = first + min(length, count - first);
    for (uint s = segment_ending_after(offsets, segments, first); s < segments && first < last; ++s) {
        const uint end = min(offsets[s + 1], last);
        first = max(first, offsets[s]);
        Space space;
        Frame axes;
        space_of(aabbs, &s, &space);
        load_frame(boxes, &s, &axes);
        for (; first < end; ++first) {
            Vector corners[CORNERS];
            load_element_in(positions, triangles, first, &space, corners);
            Slabs ends;
            empty_slabs(&ends);
            for (int k = 0; k < CORNERS; ++k) add_point(&axes, &corners[k], &ends);
            store_slabs(&ends, slabs + first);
        }
    }
}

/// boxes[s] = the box with its axes and the ends `slabs[s]`. Where `turned_slabs` belong to a smaller box, those and
/// the axes of turned[s] are taken; without a second fit both are given twice. An empty segment gets the empty box.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void finish_fits(global const uint* offsets, global const Aabb* aabbs, global const Aabb* slabs,
                 global const Aabb* turned_slabs, global const Obb* turned, global Obb* boxes, uint segments,
                 uint length, uint slices) {
    const uint slice = (uint)get_global_id(0);
    if (slice >= slices) return;
    const uint first = slice * length, last = first + min(length, segments - first);
    for (uint s = first; s < last; ++s) {
        if (offsets[s] == offsets[s + 1]) {
            const float none = 0.0f, nothing = -INFINITY;
            OrientedBox empty;
            const Vector center = {none, none, none}, extent = {nothing, nothing, nothing};
            empty.center = center;
            empty.extent = extent;
            identity_frame(&empty.axes);
            store_boxes(&empty, 0, boxes, &s, 1);
            continue;
        }
        Space space;
        Frame axes;
        Slabs ends, turned_ends;
        space_of(aabbs, &s, &space);
        load_slabs(slabs + s, &ends);
        load_slabs(turned_slabs + s, &turned_ends);
        const bool smaller_turned = half_area(&turned_ends) < half_area(&ends);
        if (smaller_turned) ends = turned_ends;
        load_frame(smaller_turned ? turned : boxes, &s, &axes);
        // What is too small beside the unit of the space was rounded to its denormals, in a coordinate and its
        // products.
        const float dust = 0x1p-146f;
        const Vector inexact = {dust, dust, dust};
        finish_boxes(&space, &axes, &ends, &inexact, boxes, &s, 1);
    }
}
