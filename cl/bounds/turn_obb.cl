// SPDX-License-Identifier: MIT
// Axes for segments whose principal axes are ill-determined, such as those of a cube, a sphere or a square: the
// vertices that reach farthest in 26 directions represent the segment, and a frame is rotated about each of its axes in
// turn until the box around them is smallest. The numbers of starts and of rounds are small and fixed. The starts are
// those of DiTO (Larsson and Kallberg 2011), the principal axes and the axes of the world.
//
// GROUP_SIZE, CORNERS, LANES, MEASURE_AREA, FALLBACK   as in fit_obb.cl
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
#include "bounds/turn.h"

/// A word that orders as the floats do, above the vertex that it belongs to.
INLINE ulong key_of(float value, uint vertex) {
    const uint bits = as_uint(value);
    const uint ordered = bits & 0x80000000u ? ~bits : bits | 0x80000000u;
    return (ulong)ordered << 32 | vertex;
}

/// keys[i] = how far element i of a segment with close[s] reaches, and at which vertex, along the two directions of
/// `pass` and against them. Other elements are not written.
/// @pre  as in fit_obb.cl.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void extreme_keys(global const float* positions, global const uint* triangles, global const uint* offsets,
                  global const Aabb* aabbs, global const uint* close, global ulong* keys, uint pass, uint count,
                  uint segments, uint length, uint slices) {
    const uint slice = (uint)get_global_id(0);
    if (slice >= slices) return;
    uint first = slice * length;
    const uint last = first + min(length, count - first);
    Vector one, two;
    direction(2 * pass, &one);
    direction(2 * pass + 1, &two);
    for (uint s = segment_ending_after(offsets, segments, first); s < segments && first < last; ++s) {
        const uint end = min(offsets[s + 1], last);
        first = max(first, offsets[s]);
        if (close[s] == 0) {
            first = max(first, end);
            continue;
        }
        Space space;
        space_of(aabbs, &s, &space);
        for (; first < end; ++first) {
            Vector corners[CORNERS];
            load_element_in(positions, triangles, first, &space, corners);
            ulong4 key = 0;
            for (int k = 0; k < CORNERS; ++k) {
                const uint vertex = vertex_of(triangles, first, k);
                const float a = dot3(&one, &corners[k]), b = dot3(&two, &corners[k]);
                key = max(key, (ulong4)(key_of(a, vertex), key_of(-a, vertex), key_of(b, vertex), key_of(-b, vertex)));
            }
            vstore4(key, first, keys);
        }
    }
}

/// vertices[28 s + 4 pass + k] = the vertex in extremes[s], for segments with close[s].
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void take_extremes(global const ulong* extremes, global const uint* close, global uint* vertices, uint pass,
                   uint segments, uint length, uint slices) {
    const uint slice = (uint)get_global_id(0);
    if (slice >= slices) return;
    const uint first = slice * length, last = first + min(length, segments - first);
    for (uint s = first; s < last; ++s)
        if (close[s] != 0) vstore4(convert_uint4(vload4(s, extremes)), 7 * (size_t)s + pass, vertices);
}

/// The axes of turned[s]: those of boxes[s], unless close[s]; then those of a small box of its extreme vertices.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void turn_axes(global const float* positions, global const Aabb* aabbs, global const uint* vertices,
               global const uint* close, global const Obb* boxes, global Obb* turned, uint segments) {
    const uint s = (uint)get_global_id(0);
    if (s >= segments) return;
    Frame axes;
    load_frame(boxes, &s, &axes);
    if (close[s] != 0) {
        Space space;
        space_of(aabbs, &s, &space);
        Vector points[EXTREMES];
        int count = 0;
        for (int k = 0; k < EXTREMES; ++k) {
            const uint vertex = vertices[EXTREMES * (size_t)s + k];
            bool known = false;
            for (int j = 0; j < k; ++j) known = known || vertices[EXTREMES * (size_t)s + j] == vertex;
            if (known) continue;
            Vector p;
            load_vertex(positions, vertex, &p);
            to_space(&space, &p, &points[count++]);
        }
        smallest_frame(points, count, &axes);
    }
    store_frame(&axes, turned, &s, 1);
}
