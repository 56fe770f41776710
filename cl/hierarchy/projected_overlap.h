// SPDX-License-Identifier: MIT
// How much of two boxes' projections is the same.
#ifndef BOXWOOD_HIERARCHY_PROJECTED_OVERLAP_H
#define BOXWOOD_HIERARCHY_PROJECTED_OVERLAP_H
#include "hierarchy/projected_area.h"

/// An outline cut by four sides and then by the edges of another one that is cut by four sides.
#define CUT_CORNERS (OUTLINE_CORNERS + 4 + OUTLINE_CORNERS + 4)

/// The outline of the box's projection, of what of it lies beyond the near plane; up to OUTLINE_CORNERS, anticlockwise.
static inline uint box_outline(const InfluenceRecord* area, Box box, float2* outline) {
    const float3 low = box.a.xyz - area_origin(area), high = (float3)(box.a.w, box.b) - area_origin(area);
    if (!(low.x <= high.x && low.y <= high.y && low.z <= high.z)) return 0;
    float2 points[OUTLINE_CORNERS];
    const uint count = points_beyond(area, corners_along(area_right(area), low, high), corners_along(area_up(area), low, high),
                                     corners_along(area_forward(area), low, high), points);
    return hull_of_points(points, count, outline);
}

/// Keeps what of a convex polygon lies to the left of the line from a to b; the number of corners that leaves.
static inline uint cut_left(float2* polygon, uint count, float2 a, float2 b) {
    float2 kept[CUT_CORNERS];
    uint size = 0;
    for (uint i = 0; i < count; ++i) {
        const float2 p = polygon[i], q = polygon[i + 1 < count ? i + 1 : 0];
        const float at_p = turn_of(a, b, p), at_q = turn_of(a, b, q);
        if (at_p >= 0.0f && size < CUT_CORNERS) kept[size++] = p;
        if ((at_p >= 0.0f) != (at_q >= 0.0f) && size < CUT_CORNERS) kept[size++] = p + (q - p) * (at_p / (at_p - at_q));
    }
    for (uint i = 0; i < size; ++i) polygon[i] = kept[i];
    return size;
}

static inline uint cut_to_rectangle(float2* polygon, uint count, float2 low, float2 high) {
    count = cut_left(polygon, count, low, (float2)(high.x, low.y));
    count = cut_left(polygon, count, (float2)(high.x, low.y), high);
    count = cut_left(polygon, count, high, (float2)(low.x, high.y));
    return cut_left(polygon, count, (float2)(low.x, high.y), low);
}

/// The area that the projections of two boxes share, and that of the smaller one, both over the rectangle's; culled, only what
/// lies in the rectangle. 0 <= overlap <= smaller, as area_chance has it.
static inline void projected_overlap(const InfluenceRecord* area, Box a, Box b, bool culled, float* overlap, float* smaller) {
    const float chance_a = area_chance(area, a, culled), chance_b = area_chance(area, b, culled);
    *smaller = fmin(chance_a, chance_b);
    *overlap = 0.0f;
    if (!(*smaller > 0.0f)) return;
    float2 first[CUT_CORNERS], second[CUT_CORNERS];
    // `first` is the smaller one, and all is in units of its own size about its centre: only ratios round.
    uint first_count = box_outline(area, chance_a <= chance_b ? a : b, first);
    uint second_count = box_outline(area, chance_a <= chance_b ? b : a, second);
    if (culled) first_count = cut_to_rectangle(first, first_count, (float2)(-1.0f), (float2)(1.0f));
    if (first_count < 3 || second_count < 3) return;
    float2 low = first[0], high = low;
    for (uint i = 1; i < first_count; ++i) {
        low = min(low, first[i]);
        high = max(high, first[i]);
    }
    const float2 centre = 0.5f * low + 0.5f * high, half_size = 0.5f * high - 0.5f * low;
    if (!(half_size.x > 0.0f && half_size.y > 0.0f)) return;
    for (uint i = 0; i < first_count; ++i) first[i] = (first[i] - centre) / half_size;
    for (uint i = 0; i < second_count; ++i) second[i] = clamp((second[i] - centre) / half_size, -LARGEST_PLACE, LARGEST_PLACE);
    second_count = cut_to_rectangle(second, second_count, (float2)(-1.0f), (float2)(1.0f));
    for (uint i = 0; i < first_count && second_count > 0; ++i)
        second_count = cut_left(second, second_count, first[i], first[i + 1 < first_count ? i + 1 : 0]);
    // The share of the smaller outline, and not its area, which is known better.
    const float whole = polygon_chance(first, first_count, false);
    if (whole > 0.0f) *overlap = *smaller * fmin(polygon_chance(second, second_count, false) / whole, 1.0f);
}

#endif
