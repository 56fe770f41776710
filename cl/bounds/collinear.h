// SPDX-License-Identifier: MIT
// Detects triangles without area, exactly, when leaves are made: once sheared along a ray (traverse/ray_triangle.h)
// their rounded vertices may span an area.
#ifndef BOXWOOD_BOUNDS_COLLINEAR_H
#define BOXWOOD_BOUNDS_COLLINEAR_H
#include "runtime/expansion.h"
#include "runtime/numerics.h"

inline float largest_of(float3 v) { return fmax(fabs(v.x), fmax(fabs(v.y), fabs(v.z))); }

/// 2^exponent / v's largest component, but for the bits of that.
inline float scale_to(float3 v, uint exponent) {
    return as_float((254u + exponent - clamp(as_uint(largest_of(v)) >> 23, 1u + exponent, 253u)) << 23);
}

/// Whether three points of a plane are on one line.
inline bool is_collinear2(float2 a, float2 b, float2 c) {
    Expansion twice_area;
    twice_area.count = 0;
    add_product(&twice_area, a.x, b.y);
    add_product(&twice_area, -a.x, c.y);
    add_product(&twice_area, b.x, c.y);
    add_product(&twice_area, -b.x, a.y);
    add_product(&twice_area, c.x, a.y);
    add_product(&twice_area, -c.x, b.y);
    return is_zero(&twice_area);
}

/// Whether three points are on one line, exactly for coordinates whose last bits are within 2^-110 of the largest
/// coordinate.
///
/// Nearly always the rounded normal decides. Edges p and q are off by u of themselves (u = 2^-24), so that a component
/// of p x q is off by 2u of its two products and, by the two roundings of each, 3u more.
inline bool is_collinear(float3 a, float3 b, float3 c) {
    const float3 p = (b - a) * scale_to(b - a, 0), q = (c - a) * scale_to(c - a, 0);
    const float3 r = p.yzx * q.zxy, s = p.zxy * q.yzx;
    const float3 doubt = (fabs(r) + fabs(s) + 0x1p-90f) * (8.0f * 0x1p-24f);
    if (any(fabs(r - s) > doubt)) return false;
    const float scale = scale_to(fmax(fmax(fabs(a), fabs(b)), fabs(c)), 40);
    a *= scale;
    b *= scale;
    c *= scale;
    return is_collinear2(a.xy, b.xy, c.xy) && is_collinear2(a.yz, b.yz, c.yz) && is_collinear2(a.zx, b.zx, c.zx);
}

/// The vertices as leaves have them: thrice the first where they are on one line.
inline void mark_collinear(const float3* a, float3* b, float3* c) {
    if (!is_collinear(*a, *b, *c)) return;
    *b = *a;
    *c = *a;
}

#endif
