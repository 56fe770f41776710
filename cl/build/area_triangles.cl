// SPDX-License-Identifier: MIT
// Finds the triangles that reach into the region of an influence area, by separating axes in the coordinates of the
// area.
//
// A triangle is left out only when, along some axis n, it is apart from the region by more than `margin`. Any axis will
// do, so the rounding of n does not matter. With e = 2^-24, N the sum of n's magnitudes, D the largest sum of
// the magnitudes of what separates a corner from the area's origin and R that of the region's points, a corner's
// coordinates are off by at most 4 e D, its place along n by 4 e D N + 3 e D N, and the region's ends by 6 e R N. Where
// rays are in the region by influence.h, points are outside it by at most 24 e R (1 + t) at each side, so along n by 24
// e R (1 + t) N (1 + t). What remains of the margin, 128 e (D + R) N (1 + t)^2, covers that a hit's distance rounds: by
// a few e times the coordinates of the triangle. The axes are all that it takes for two convex bodies: the region's
// normals, the triangle's, and the crosses of their edges.
// compile: GROUP_SIZE=1
#include "influence/influence.h"

/// The region, and a triangle in the area's coordinates.
typedef struct Pair {
    float3 corner[3];
    float width, height, near, far, growth; ///< growth: half extents grow by it with depth: 1 for point areas, else 0.
    float margin;                           ///< For an axis whose magnitudes add up to 1.
} Pair;

/// Whether the two are surely apart along an axis of any length.
INLINE bool apart(const Pair* pair, float3 axis) {
    const float scale = component_sum(axis);
    if (!(scale > 0.0f)) return false;
    const float3 n = axis / scale;
    float low = FLT_MAX, high = -FLT_MAX;
    for (int i = 0; i < 3; ++i) {
        const float3 p = pair->corner[i];
        const float at = (n.x * p.x + n.y * p.y) + n.z * p.z;
        low = fmin(low, at);
        high = fmax(high, at);
    }
    // The rectangle at each end of the region.
    const float reach = fabs(n.x) * pair->width + fabs(n.y) * pair->height;
    const float first = pair->growth > 0.0f ? pair->near * reach : reach,
                last = pair->growth > 0.0f ? pair->far * reach : reach;
    const float least = fmin(pair->near * n.z - first, pair->far * n.z - last);
    const float most = fmax(pair->near * n.z + first, pair->far * n.z + last);
    return low - most > pair->margin || least - high > pair->margin;
}

/// apart() along the crosses of one edge of the region and the triangle's edges, whose largest components are 1.
INLINE bool apart_by_edges(const Pair* pair, const float3* edges, float3 edge) {
    for (int i = 0; i < 3; ++i) {
        const float3 a = edges[i];
        if (apart(pair,
                  (float3)(a.y * edge.z - a.z * edge.y, a.z * edge.x - a.x * edge.z, a.x * edge.y - a.y * edge.x)))
            return true;
    }
    return false;
}

INLINE float3 unit_edge(float3 from, float3 to) {
    const float3 edge = to - from;
    const float size = largest_component(edge);
    return edge / (size > 0.0f ? size : 1.0f);
}

INLINE bool are_apart(const Pair* pair) {
    const float w = pair->growth * pair->width, h = pair->growth * pair->height;
    const float3 x = (float3)(1.0f, 0.0f, 0.0f), y = (float3)(0.0f, 1.0f, 0.0f);
    if (apart(pair, (float3)(0.0f, 0.0f, 1.0f))) return true;
    if (apart(pair, x) || apart(pair, y)) return true; // for point areas the box around the region
    if (pair->growth > 0.0f && (apart(pair, (float3)(1.0f, 0.0f, w)) || apart(pair, (float3)(1.0f, 0.0f, -w)) ||
                                apart(pair, (float3)(0.0f, 1.0f, h)) || apart(pair, (float3)(0.0f, 1.0f, -h))))
        return true;
    const float3 edges[3] = {unit_edge(pair->corner[0], pair->corner[1]), unit_edge(pair->corner[1], pair->corner[2]),
                             unit_edge(pair->corner[2], pair->corner[0])};
    const float3 a = edges[0], b = edges[2];
    if (apart(pair, (float3)(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x))) return true;
    if (apart_by_edges(pair, edges, x) || apart_by_edges(pair, edges, y)) return true;
    if (!(pair->growth > 0.0f)) return apart_by_edges(pair, edges, (float3)(0.0f, 0.0f, 1.0f));
    return apart_by_edges(pair, edges, (float3)(w, h, 1.0f)) || apart_by_edges(pair, edges, (float3)(-w, h, 1.0f)) ||
           apart_by_edges(pair, edges, (float3)(w, -h, 1.0f)) || apart_by_edges(pair, edges, (float3)(-w, -h, 1.0f));
}

/// flags[i] = 1 where triangle i may have a point in the region of area[0], else 0; indices[i] = i.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void area_triangles(global const InfluenceRecord* area, global const float* positions, global const uint* triangles,
                    global uint* flags, global uint* indices, uint count) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const float3 origin = vload3(0, area->origin);
    Pair pair;
    float size = 0.0f;
    for (int k = 0; k < 3; ++k) {
        const float3 from = vload3(triangles[3 * (size_t)i + k], positions) - origin;
        size = fmax(size, component_sum(from));
        pair.corner[k] = in_area_frame(area, from);
    }
    pair.width = area->half_width;
    pair.height = area->half_height;
    pair.near = area->near;
    pair.far = area->far;
    pair.growth = area->point != 0 ? 1.0f : 0.0f;
    const float sides = pair.width + pair.height, spread = 1.0f + pair.growth * fmax(pair.width, pair.height);
    // 128 e, and as much again for what the margin itself rounds.
    pair.margin = 0x1p-16f * (size + pair.far + (pair.growth > 0.0f ? pair.far * sides : sides)) * spread * spread;
    flags[i] = are_apart(&pair) ? 0u : 1u;
    indices[i] = i;
}
