// SPDX-License-Identifier: MIT
// End-point overlap (Aila, Karras and Laine 2013): how much of each triangle lies inside nodes that it is not below.
//
// A triangle is clipped in its own plane: a point of it is v0 + s (v1 - v0) + t (v2 - v0), so a box is six half-planes
// of (s, t) and the clipped fraction of the area is that of a polygon in (s, t), whatever the frame of the box.
// ORIENTED=1: nodes have oriented boxes unless they keep their AABB; 0: AABBs.
// compile: ORIENTED=0
// compile: ORIENTED=1
#include "runtime/products.h"
#include "primitives/segments.h"
#include "volumes/ranges.h"
#include "shared/aabb.h"
#include "shared/obb.h"
#include "shared/triangle.h"

#ifndef ORIENTED
#error "overlap.cl: define ORIENTED as 0 or 1"
#endif

// A triangle cut by six planes has at most three plus six corners.
#define MOST_CORNERS 9

/// The coordinates of v0, v1 and v2 along one axis of a box, and the box's interval there.
typedef struct Slab {
    float3 corners;
    float low;
    float high;
} Slab;

INLINE void aabb_slab(global const Aabb* box, global const Triangle* triangle, int k, Slab* slab) {
    const float v0 = triangle->v0[k];
    slab->corners = (float3)(v0, triangle->v1[k], triangle->v2[k]);
    slab->low = box->min[k];
    slab->high = box->max[k];
}

#if ORIENTED
INLINE void obb_slab(global const Obb* box, global const Triangle* triangle, int k, Slab* slab) {
    global const float* axis = box->axes + 3 * k;
    slab->corners = (float3)(0.0f);
    for (int i = 0; i < 3; ++i)
        slab->corners += axis[i] * ((float3)(triangle->v0[i], triangle->v1[i], triangle->v2[i]) - box->center[i]);
    slab->low = -box->extent[k];
    slab->high = box->extent[k];
}
#endif

/// Cuts the polygon of `corners` points (s, t) to where plane . (1 - s - t, s, t) >= 0. Returns the new number of
/// points.
INLINE int clip(float2* polygon, int corners, float3 plane) {
    float2 kept[MOST_CORNERS];
    int count = 0;
    for (int i = 0; i < corners; ++i) {
        const float2 a = polygon[i], b = polygon[i + 1 < corners ? i + 1 : 0];
        const float at_a = dot_float3(plane, (float3)(1.0f - a.x - a.y, a));
        const float at_b = dot_float3(plane, (float3)(1.0f - b.x - b.y, b));
        if (at_a >= 0.0f && count < MOST_CORNERS) kept[count++] = a;
        if ((at_a >= 0.0f) != (at_b >= 0.0f) && count < MOST_CORNERS)
            kept[count++] = a + at_a / (at_a - at_b) * (b - a);
    }
    for (int i = 0; i < count; ++i) polygon[i] = kept[i];
    return count;
}

/// Twice the area of a polygon in (s, t): 1 for the whole triangle.
INLINE float fraction_of_polygon(const float2* polygon, int corners) {
    float sum = 0.0f;
    for (int i = 2; i < corners; ++i) {
        const float2 a = polygon[i - 1] - polygon[0], b = polygon[i] - polygon[0];
        sum += a.x * b.y - a.y * b.x;
    }
    return clamp(sum, 0.0f, 1.0f);
}

/// The fraction of the triangle's area inside the box of slabs; -1 where they do not meet.
INLINE float fraction_inside(const Slab* slabs) {
    bool inside = true;
    for (int k = 0; k < 3; ++k) {
        const float3 c = slabs[k].corners;
        const float least = min(min(c.x, c.y), c.z), most = max(max(c.x, c.y), c.z);
        if (!(least <= slabs[k].high && most >= slabs[k].low)) return -1.0f;
        inside = inside && least >= slabs[k].low && most <= slabs[k].high;
    }
    if (inside) return 1.0f;
    float2 polygon[MOST_CORNERS] = {(float2)(0.0f, 0.0f), (float2)(1.0f, 0.0f), (float2)(0.0f, 1.0f)};
    int corners = 3;
    for (int k = 0; k < 3; ++k) {
        corners = clip(polygon, corners, slabs[k].corners - slabs[k].low);
        corners = clip(polygon, corners, slabs[k].high - slabs[k].corners);
    }
    return corners > 0 ? fraction_of_polygon(polygon, corners) : -1.0f;
}

INLINE float fraction_inside_node(global const Aabb* volumes, global const Obb* boxes, uint node,
                                  global const Triangle* triangle) {
    Slab slabs[3];
#if ORIENTED
    if (boxes[node].aligned == 0) {
        for (int k = 0; k < 3; ++k) obb_slab(boxes + node, triangle, k, slabs + k);
        return fraction_inside(slabs);
    }
#endif
    (void)boxes;
    for (int k = 0; k < 3; ++k) aabb_slab(volumes + node, triangle, k, slabs + k);
    return fraction_inside(slabs);
}

/// The next node of the walk in depth-first order when nothing below `node` is of interest; BOXWOOD_NONE at the end.
inline uint after(uint node, uint root, global const uint2* children, global const uint* parents) {
    while (node != root) {
        const uint parent = parents[node];
        const uint2 pair = children[parent];
        if (pair.x == node) return pair.y;
        node = parent;
    }
    return BOXWOOD_NONE;
}

/// Sample i of `samples` is the triangle at sorted position floor(i count / samples). fractions[i] = sum, over the
/// nodes that are not above it and whose ancestors all meet it, of the fraction of its area inside them; areas[i] = its
/// area in units of unit^2; visits[i] = nodes that were looked at, each at most once. The walk goes by parents and
/// needs no stack.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void end_point_overlap(global const uint2* children, global const uint* parents, global const uint* far_ends,
                       global const uint* offsets, global const Aabb* volumes, global const Obb* boxes,
                       global const Triangle* triangles, global float* fractions, global float* areas,
                       global uint* visits, float unit, uint trees, uint count, uint samples) {
    const uint sample = (uint)get_global_id(0);
    if (sample >= samples) return;
    const uint position = (uint)((ulong)sample * count / samples);
    global const Triangle* triangle = triangles + position;
    const float3 v0 = vload3(0, triangle->v0);
    const float3 edge1 = (vload3(0, triangle->v1) - v0) / unit, edge2 = (vload3(0, triangle->v2) - v0) / unit;
    areas[sample] = 0.5f * length_float3(cross_float3(edge1, edge2));

    const uint tree = segment_of(offsets, trees, position);
    const uint root = offsets[tree + 1] - offsets[tree] > 1 ? offsets[tree] : count + offsets[tree];
    float sum = 0.0f;
    uint visited = 0;
    for (uint node = root; node != BOXWOOD_NONE; ++visited) {
        const uint2 range = range_of(node, far_ends, count);
        bool below = position >= range.x && position <= range.y;
        if (!below) {
            const float fraction = fraction_inside_node(volumes, boxes, node, triangle);
            below = fraction >= 0.0f;
            sum += max(fraction, 0.0f);
        }
        node = below && node < count ? children[node].x : after(node, root, children, parents);
    }
    fractions[sample] = sum;
    visits[sample] = visited;
}
