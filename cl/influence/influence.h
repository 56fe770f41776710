// SPDX-License-Identifier: MIT
// Rays and influence areas: whether a ray follows an area, and how far it is in its region.
//
// A ray is in the region from its origin, where area_contains, to area_exit, but for what rounding leaves its origin
// outside. With e = 2^-24, s the sum of the magnitudes of the point less the area's origin, and t the tangent of half
// the field of view (0 for plane areas): coordinates have errors up to 4 e s, the room to a side, z t - |x|, up to 8 e
// s (1 + t). It is taken as 16 e s (1 + t): area_contains accepts every point of the region, and none further outside
// than 24 e s (1 + t) by that measure; area_exit takes as much off the room ahead. Speeds, of directions whose largest
// component is 1, have errors up to 24 e (1 + t), and are taken as 32 e (1 + t) faster. area_triangles.cl has triangles
// a multiple of all that around the region.
#ifndef BOXWOOD_INFLUENCE_INFLUENCE_H
#define BOXWOOD_INFLUENCE_INFLUENCE_H
#include "runtime/inline.h"
#include "runtime/numerics.h"
#include "shared/influence.h"

#define ROOM_ROUNDING 0x1p-20f  // 16 e
#define SPEED_ROUNDING 0x1p-19f // 32 e

INLINE float largest_component(float3 v) { return fmax(fabs(v.x), fmax(fabs(v.y), fabs(v.z))); }
INLINE float component_sum(float3 v) { return fabs(v.x) + fabs(v.y) + fabs(v.z); }

/// right, up, forward coordinates of a difference of points.
INLINE float3 in_area_frame(global const InfluenceRecord* area, float3 v) {
    const float3 right = vload3(0, area->right), up = vload3(0, area->up), forward = vload3(0, area->forward);
    return (float3)((right.x * v.x + right.y * v.y) + right.z * v.z, (up.x * v.x + up.y * v.y) + up.z * v.z,
                    (forward.x * v.x + forward.y * v.y) + forward.z * v.z);
}

/// Whether a point is in the region, but for rounding: all points of the region are.
INLINE bool area_contains(global const InfluenceRecord* area, float3 point) {
    const float3 from = point - vload3(0, area->origin);
    const float3 p = in_area_frame(area, from);
    const float width = area->half_width, height = area->half_height, rounding = ROOM_ROUNDING * component_sum(from);
    const float spread = area->point != 0 ? p.z : 1.0f;
    const float widths = area->point != 0 ? 1.0f + width : 1.0f, heights = area->point != 0 ? 1.0f + height : 1.0f;
    return fabs(p.x) - spread * width <= rounding * widths && fabs(p.y) - spread * height <= rounding * heights &&
           area->near - p.z <= rounding && p.z - area->far <= rounding;
}

/// Whether a ray runs along the area's lines, either way, but for the tolerance and rounding. From the eye of a point
/// area all do. Directions of any length but 0.
INLINE bool is_direction_affine(global const InfluenceRecord* area, float3 origin, float3 direction) {
    float3 own = vload3(0, area->forward);
    if (area->point != 0) own = origin - vload3(0, area->origin);
    const float own_size = largest_component(own), size = largest_component(direction);
    if (!(size > 0.0f)) return false;
    if (!(own_size > 0.0f)) return true;
    const float3 a = own / own_size, b = direction / size;
    const float3 c = (float3)(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
    const float sine = area->sin_tolerance + 0x1p-21f;
    return (c.x * c.x + c.y * c.y) + c.z * c.z <=
           sine * sine * ((a.x * a.x + a.y * a.y) + a.z * a.z) * ((b.x * b.x + b.y * b.y) + b.z * b.z);
}

/// Until when a ray that nears a side at `speed` is sure not to cross it. The factor, 1 - 16 e, covers what rounds
/// relatively: room and speed (e each), two quotients (5 e each, the second area_exit's) and the product (e).
INLINE float time_to_side(float room, float speed) {
    return speed > 0.0f ? fmax(room, 0.0f) / speed * (1.0f - 0x1p-20f) : FLT_MAX;
}

/// How far along a direction of any length, in units of it, a ray from a point of the region is in the region at least:
/// never more than it is. 0 where it leaves at once, or has no direction.
INLINE float area_exit(global const InfluenceRecord* area, float3 origin, float3 direction) {
    const float scale = largest_component(direction);
    if (!(scale > 0.0f)) return 0.0f;
    const float3 from = origin - vload3(0, area->origin);
    const float3 p = in_area_frame(area, from), v = in_area_frame(area, direction / scale);
    const float width = area->half_width, height = area->half_height, rounding = ROOM_ROUNDING * component_sum(from);
    const bool point = area->point != 0;
    const float spread = point ? p.z : 1.0f, growth = point ? v.z : 0.0f;
    const float widths = point ? 1.0f + width : 1.0f, heights = point ? 1.0f + height : 1.0f;
    const float room_x = spread * width - rounding * widths - (point ? 0.0f : ROOM_ROUNDING * width);
    const float room_y = spread * height - rounding * heights - (point ? 0.0f : ROOM_ROUNDING * height);
    const float speed_x = SPEED_ROUNDING * widths - growth * width,
                speed_y = SPEED_ROUNDING * heights - growth * height;
    float time = fmin(time_to_side(room_x - p.x, speed_x + v.x), time_to_side(room_x + p.x, speed_x - v.x));
    time = fmin(time, fmin(time_to_side(room_y - p.y, speed_y + v.y), time_to_side(room_y + p.y, speed_y - v.y)));
    time = fmin(time, time_to_side(area->far * (1.0f - ROOM_ROUNDING) - rounding - p.z, v.z + SPEED_ROUNDING));
    time = fmin(time, time_to_side(p.z - area->near * (1.0f + ROOM_ROUNDING) - rounding, SPEED_ROUNDING - v.z));
    const float exit = fmin(time / scale, FLT_MAX);
    return fmin(time, exit) >= FLT_MIN ? exit : 0.0f; // below, rounding is not relative
}

#endif
