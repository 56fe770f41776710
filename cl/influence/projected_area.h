// SPDX-License-Identifier: MIT
// The probability that a ray of an influence area meets a box: the area of the box's projection over that of the
// rectangle that the rays leave.
//
// A box beyond the near plane, and inside the rectangle where that matters, is the sum of its faces in sight, without
// cancellation. With f the forward axis and e the extents, a plane area sees |f.x| e.y e.z + |f.y| e.x e.z + |f.z| e.x
// e.y, three parallelograms. A point area sees at most three faces; a triangle with corners p, q, r at the depths a, b,
// c has the area |det(p, q, r)| / (2 a b c) on the plane of depth 1, and for both halves of a face the determinant is
// the face's distance from the eye along its axis times its area. So a face of the depths a, b, c, d (a opposite to d)
// has distance * area * (a + d) / (2 a b c d).
//
// Else the outline, by hull_table.h or, for a box across the near plane, as the hull of what lies beyond it, is cut to
// the rectangle: at each x the outline's two heights are clamped to the rectangle, and what is between them is
// integrated.
//
// Accuracy, e = 2^-24, for what the record's floats say and a box of float corners, R the largest distance from the
// origin / depth of its corners (0 for plane areas): relative (20 R + 24) e for the sum of faces. An outline's corners,
// at u in units of the rectangle's half extents, are off by at most d = e (8 D / H + (8 R + 4) |u|), D the corners'
// largest distance from the origin and H the smaller half extent times the least depth (times 1 for plane areas), and
// then, culled, the probability by 3 d + 20 e, where a depth is off by at most 6 e D: whether a box just before the
// rectangle counts is open. Nothing overflows or is NaN from 2^-60 to 2^60: probabilities stop at LARGEST_PROBABILITY,
// and quotients above 2^42 count as 2^42.
#ifndef BOXWOOD_INFLUENCE_PROJECTED_AREA_H
#define BOXWOOD_INFLUENCE_PROJECTED_AREA_H
#include "bounds/box.h"
#include "influence/hull_table.h"
#include "runtime/products.h"
#include "shared/influence.h"

#define LARGEST_PROBABILITY 0x1p60f
#define LARGEST_COORDINATE 0x1p60f

INLINE float3 area_right(const InfluenceRecord* area) {
    return (float3)(area->right[0], area->right[1], area->right[2]);
}
INLINE float3 area_up(const InfluenceRecord* area) { return (float3)(area->up[0], area->up[1], area->up[2]); }
INLINE float3 area_forward(const InfluenceRecord* area) {
    return (float3)(area->forward[0], area->forward[1], area->forward[2]);
}
INLINE float3 area_origin(const InfluenceRecord* area) {
    return (float3)(area->origin[0], area->origin[1], area->origin[2]);
}

/// The direction of the area's own ray through a point, of length 1.
INLINE float3 area_direction(const InfluenceRecord* area, float3 point) {
    const float3 forward = area_forward(area);
    if (area->point == 0) return forward;
    const float3 way = point - area_origin(area);
    const float scale = fmax(fabs(way.x), fmax(fabs(way.y), fabs(way.z)));
    if (!(scale > 0.0f)) return forward;
    const float3 scaled = way / scale;
    return scaled / sqrt(dot_float3(scaled, scaled));
}

/// Coordinates along `axis` of the eight corners, which lie at `low` and `high` from the origin. Rounding keeps order
/// along each edge, so a plane across cuts them as it cuts a box: at most ten corners.
INLINE float8 corners_along(float3 axis, float3 low, float3 high) {
    const float3 a = axis * low, b = axis * high;
    return ((float8)(a.x, b.x, a.x, b.x, a.x, b.x, a.x, b.x) + (float8)(a.y, a.y, b.y, b.y, a.y, a.y, b.y, b.y)) +
           (float8)(a.z, a.z, a.z, a.z, b.z, b.z, b.z, b.z);
}

INLINE float least_of(float8 v) {
    const float4 a = LESSER(v.lo, v.hi);
    return fmin(fmin(a.x, a.y), fmin(a.z, a.w));
}
INLINE float most_of(float8 v) {
    const float4 a = GREATER(v.lo, v.hi);
    return fmax(fmax(a.x, a.y), fmax(a.z, a.w));
}

/// The projection of one face over the rectangle's area. `depths` and `inverse`: of its corners, 0 opposite to 3.
/// `scale`: half of one over the rectangle's half extents.
INLINE float face_probability(float distance, float width, float height, float4 depths, float4 inverse, float2 scale) {
    // The longest side over the largest depth, so that no quotient is larger than it must be.
    const float longer = fmax(width, height), shorter = fmin(width, height);
    const float longest = fmax(longer, distance), shortest = fmin(shorter, distance);
    const float middle = fmax(shorter, fmin(longer, distance));
    const float a = fmax(inverse.x, inverse.w), b = fmin(inverse.x, inverse.w);
    const float c = fmax(inverse.y, inverse.z), d = fmin(inverse.y, inverse.z);
    const float p = fmin(a, c), q = fmax(b, d);
    const float mean = 0.5f * (depths.x + depths.w) * fmin(b, d); // of two opposite depths over the largest
    const float first = fmin(longest * fmin(p, q) * scale.x, 0x1p42f);
    const float second = fmin(middle * fmax(p, q) * scale.y, 0x1p42f);
    const float third = fmin(shortest * fmax(a, c), 0x1p42f);
    return mean * first * second * third;
}

/// The whole projection of a box beyond the near plane; `depths` are those of its corners.
INLINE float faces_probability(const InfluenceRecord* area, Box box, float3 low, float3 high, float8 depths) {
    const float3 size = extent_of(box);
    const float2 scale = 0.5f / (float2)(area->half_width, area->half_height);
    if (area->point == 0) {
        const float3 facing = fabs(area_forward(area));
        const float3 a = min(size * scale.x, 0x1p62f), b = min(size * scale.y, 0x1p62f);
        return facing.x * a.y * b.z + facing.y * a.x * b.z + facing.z * a.x * b.y;
    }
    const float8 inverse = 1.0f / depths;
    float sum = 0.0f;
    if (low.x > 0.0f) sum += face_probability(low.x, size.y, size.z, depths.even, inverse.even, scale);
    if (high.x < 0.0f) sum += face_probability(-high.x, size.y, size.z, depths.odd, inverse.odd, scale);
    if (low.y > 0.0f) sum += face_probability(low.y, size.x, size.z, depths.s0145, inverse.s0145, scale);
    if (high.y < 0.0f) sum += face_probability(-high.y, size.x, size.z, depths.s2367, inverse.s2367, scale);
    if (low.z > 0.0f) sum += face_probability(low.z, size.x, size.y, depths.lo, inverse.lo, scale);
    if (high.z < 0.0f) sum += face_probability(-high.z, size.x, size.y, depths.hi, inverse.hi, scale);
    return sum;
}

/// The integral of clamp(y, least.y, most.y) along the edge from p to q where x is between least.x and most.x.
INLINE float edge_integral(float2 p, float2 q, float2 least, float2 most) {
    const float width = q.x - p.x, height = q.y - p.y;
    const float from = clamp(p.x, least.x, most.x), to = clamp(q.x, least.x, most.x);
    if (from == to) return 0.0f;
    const float a = p.y + height * ((from - p.x) / width), b = q.y - height * ((q.x - to) / width);
    const float begin = clamp(a, least.y, most.y), end = clamp(b, least.y, most.y);
    // Fractions of the way before it enters and after it leaves.
    const float before = begin == end ? 0.0f : (begin - a) / (b - a);
    const float after = begin == end ? 0.0f : (b - end) / (b - a);
    return 0.5f * (begin + end + (before - after) * (begin - end)) * (to - from);
}

/// Where the outline may count: the rectangle, or everything.
INLINE float outline_limit(bool culled) { return culled ? 1.0f : 2.0f * LARGEST_COORDINATE; }

/// The probability of the outline of `faces` by the projections of the box's corners.
static inline float table_probability(uint faces, float8 u, float8 v, float2 centre, float limit) {
    const uint entry = hull_table[faces];
    const uint count = entry >> 18;
    if (count == 0) return 0.0f;
    float us[8], vs[8];
    vstore8(u, 0, us);
    vstore8(v, 0, vs);
    const float2 least = -limit - centre, most = limit - centre;
    uint corner = (entry >> (3 * (count - 1))) & 7u;
    float2 p = (float2)(us[corner], vs[corner]) - centre;
    float sum = 0.0f;
    for (uint i = 0; i < count; ++i) {
        corner = (entry >> (3 * i)) & 7u;
        const float2 q = (float2)(us[corner], vs[corner]) - centre;
        sum += edge_integral(p, q, least, most);
        p = q;
    }
    return 0.25f * fabs(sum);
}

/// A convex polygon: in units of the rectangle's half extents. A box cut by a plane has at most ten corners.
#define OUTLINE_CORNERS 10

/// A point of the rectangle's plane in units of its half extents.
INLINE float2 project(const InfluenceRecord* area, float x, float y, float depth) {
    const float unit = area->point != 0 ? depth : 1.0f;
    return clamp((float2)(x / unit, y / unit) / (float2)(area->half_width, area->half_height), -LARGEST_COORDINATE,
                 LARGEST_COORDINATE);
}

/// The corners of what of the box lies at the depth `near` or beyond, projected; their number.
static inline uint points_beyond(const InfluenceRecord* area, float8 x, float8 y, float8 z, float2* points) {
    float xs[8], ys[8], zs[8];
    vstore8(x, 0, xs);
    vstore8(y, 0, ys);
    vstore8(z, 0, zs);
    const float near = area->near;
    uint count = 0;
    for (uint i = 0; i < 8; ++i) {
        const bool beyond = zs[i] >= near;
        if (beyond && count < OUTLINE_CORNERS) points[count++] = project(area, xs[i], ys[i], zs[i]);
        for (uint side = 1; side < 8; side *= 2) { // the edges to the corners above
            const uint other = i | side;
            if (other == i || beyond == (zs[other] >= near)) continue;
            const bool closer = fabs(zs[other] - near) < fabs(zs[i] - near); // from the end closer to the plane
            const uint a = closer ? other : i, b = closer ? i : other;
            const float fraction = (near - zs[a]) / (zs[b] - zs[a]);
            if (count < OUTLINE_CORNERS)
                points[count++] =
                    project(area, xs[a] + fraction * (xs[b] - xs[a]), ys[a] + fraction * (ys[b] - ys[a]), near);
        }
    }
    return count;
}

INLINE float turn_of(float2 a, float2 b, float2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

/// The hull of 1 to OUTLINE_CORNERS points by monotone chains, which it sorts; anticlockwise, and its number of
/// corners.
static inline uint hull_of_points(float2* points, uint count, float2* outline) {
    for (uint i = 1; i < count; ++i) {
        const float2 p = points[i];
        uint at = i;
        for (; at > 0 && (points[at - 1].x > p.x || (points[at - 1].x == p.x && points[at - 1].y > p.y)); --at)
            points[at] = points[at - 1];
        points[at] = p;
    }
    float2 chain[2 * OUTLINE_CORNERS];
    uint size = 0, start = 0;
    for (uint step = 0; step < 2 * count; ++step) {
        if (step == count) start = size > 0 ? size - 1 : 0; // the upper chain begins at the last point
        const float2 p = points[step < count ? step : 2 * count - 1 - step];
        while (size >= start + 2 && turn_of(chain[size - 2], chain[size - 1], p) <= 0.0f) --size;
        if (size == 0 || chain[size - 1].x != p.x || chain[size - 1].y != p.y) chain[size++] = p;
    }
    if (size > 1 && chain[size - 1].x == chain[0].x && chain[size - 1].y == chain[0].y) --size;
    size = min(size, (uint)OUTLINE_CORNERS);
    for (uint i = 0; i < size; ++i) outline[i] = chain[i];
    return size;
}

/// The probability of a convex polygon.
static inline float polygon_probability(const float2* outline, uint count, bool culled) {
    if (count < 3) return 0.0f;
    const float limit = outline_limit(culled);
    float2 low = outline[0], high = low;
    for (uint i = 1; i < count; ++i) {
        low = min(low, outline[i]);
        high = max(high, outline[i]);
    }
    const float2 centre = 0.5f * (max(low, -limit) + min(high, limit));
    float sum = 0.0f;
    for (uint i = 0; i < count; ++i)
        sum += edge_integral(outline[i] - centre, outline[i + 1 < count ? i + 1 : 0] - centre, -limit - centre,
                             limit - centre);
    return 0.25f * fabs(sum);
}

/// The probability of a box across the near plane.
static inline float near_plane_probability(const InfluenceRecord* area, float3 low, float3 high, float8 z,
                                           bool culled) {
    float2 points[OUTLINE_CORNERS], outline[OUTLINE_CORNERS];
    const uint count = points_beyond(area, corners_along(area_right(area), low, high),
                                     corners_along(area_up(area), low, high), z, points);
    return polygon_probability(outline, hull_of_points(points, count, outline), culled);
}

/// The probability that a ray of the area meets a box: the area of the box's projection along the area's rays over that
/// of the rectangle that they leave. What lies before the rectangle does not count, nor, culled, what projects beside
/// it. In [0, 1] culled, else in [0, LARGEST_PROBABILITY]. An empty box has none.
static inline float area_probability(const InfluenceRecord* area, Box box, bool culled) {
    const float3 low = box.a.xyz - area_origin(area), high = (float3)(box.a.w, box.b) - area_origin(area);
    if (!(low.x <= high.x && low.y <= high.y && low.z <= high.z)) return 0.0f;
    const float8 z = corners_along(area_forward(area), low, high);
    if (most_of(z) < area->near) return 0.0f;
    const float most = culled ? 1.0f : LARGEST_PROBABILITY;
    float probability;
    if (!(least_of(z) >= area->near)) {
        probability = near_plane_probability(area, low, high, z, culled);
    } else {
        if (culled) {
            float8 u = corners_along(area_right(area), low, high), v = corners_along(area_up(area), low, high);
            if (area->point != 0) {
                u /= z;
                v /= z;
            }
            u = clamp(u * (1.0f / area->half_width), -LARGEST_COORDINATE, LARGEST_COORDINATE);
            v = clamp(v * (1.0f / area->half_height), -LARGEST_COORDINATE, LARGEST_COORDINATE);
            const float2 least = (float2)(least_of(u), least_of(v)), greatest = (float2)(most_of(u), most_of(v));
            if (least.x > 1.0f || least.y > 1.0f || greatest.x < -1.0f || greatest.y < -1.0f) return 0.0f;
            if (least.x < -1.0f || least.y < -1.0f || greatest.x > 1.0f || greatest.y > 1.0f) {
                const uint faces = area->point != 0 ? faces_from_eye(low, high) : faces_along(area_forward(area));
                const float2 centre = 0.5f * (max(least, -1.0f) + min(greatest, 1.0f));
                return fmin(table_probability(faces, u, v, centre, 1.0f), 1.0f);
            }
        }
        probability = faces_probability(area, box, low, high, z);
    }
    return probability <= most ? probability : most; // and if it is NaN
}

#endif
