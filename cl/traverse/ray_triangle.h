// SPDX-License-Identifier: MIT
// Ray against triangle, watertight (Woop, Benthin and Wald 2013): no ray passes between two triangles at the edge or
// vertex that they share. One triangle or four at a time; both layouts run the same text, on float or float4, so a
// triangle gives the same bits in both.
//
// The vertices are sheared, each by itself, into a plane across the ray, whose point there is 0. Edge functions are
// differences of two products with an exact sign (Kahan), so that in this plane the test is exact, edges and vertices
// included: triangles that share rounded vertices leave no gap.
//
// Why the answer does not depend on boxes. Let u = 2^-24, all that follows relative to the origin and the axes numbered
// as in Shear, so that |d_x|, |d_y| <= |d_z|. With x_i = fl(v_i.x - o.x), and z_i likewise, a vertex is sheared to
//     a_i = (d_z x_i - d_x z_i (1 + e_i)) (1 + f_i),    |e_i|, |f_i| <= u.
// The ray hits when weights w_i >= 0 of sum 1 have sum w_i a_i = 0 and the same along y. Let X = sum w_i x_i, Z = sum
// w_i z_i. As subtraction is monotone and the weights are convex, X lies between fl(low - o.x) and fl(high - o.x) for
// every box around the vertices: the very differences that the box test forms. And d_z X - d_x Z is
//     sum w_i d_x z_i e_i + sum w_i (d_z x_i - ...) (-f_i),
// the first at most u |d_x| (|Z| + D), D being the triangle's longest extent, as |z_i| <= |z_i - Z| + |Z|; the second,
// since the a_i average to 0, at most u/2 of their range, that is u |d_z| D. So along x the ray is at X at the distance
// Z / d_z, but for u of that distance and 2u D of length.
//
// The hit distance is t = (z_0 S + (V (z_1 - z_0) + W (z_2 - z_0))) / (S d_z) with S = U + V + W. The inner sum over S
// is at most D, off by at most 9u of D (edge functions 2u, differences, products and sums 3u, S 4u); z_0 S, as |z_0| <=
// |Z| + D, and the outer sum round by 2u (|Z| + 2D), the denominator by u, the division by 5u. So t is off by 8u of
// itself and 13u D of length, and with u from the shear and 16u D in all, as |d_x| <= |d_z|:
//     every plane of a box around the triangle, moved outward by 16u D and its distance scaled by 1 -/+ 9u, lies on the
//     right side of t.
// Boxes of triangles are moved by that (padded_triangle_box, bounds/triangle_box.h) and all other boxes are around
// these; BOX_SLACK is 20u, of which the box test's own roundings take 7u. Where d_x is zero, so is e_i's term, a_i =
// d_z x_i exactly in sign, and the box test compares the same differences with 0. The same holds for oriented boxes
// (ray_obb.h), and t is clamped to the triangle's own extent along the ray.
//
// Where a product underflows an edge function may become 0, or less exact, but never change its sign. Triangles whose
// area across the ray is below 2^-60 in units of traced length (2^-30 of the scene's radius, so 2^-120 of its square)
// are not hit; those that are have D >= 2^-30, and what 2^-149 does to their edge functions and to the sums above, also
// where d_x is below 2^-90, is far below u D.
#ifndef BOXWOOD_TRAVERSE_RAY_TRIANGLE_H
#define BOXWOOD_TRAVERSE_RAY_TRIANGLE_H
#include "traverse/leaf.h"
#include "traverse/local_ray.h"

#define LEAST_AREA 0x1p-60f

/// What the test needs of a ray. The axes are numbered so that z is the one along which the ray is fastest.
typedef struct Shear {
    size_t x, y, z;
    float origin_x, origin_y, origin_z;
    float direction_x, direction_y, direction_z; ///< Times a power of two; see make_shear.
    float scale; ///< A power of two: along z, lengths times it over the depth are distances.
    float minus_depth;
} Shear;

/// The direction is scaled by a power of two to a largest component from 1 to 2, and lengths by the ray's
/// 2^exponent,
/// which makes all that there is in the space at most some 2^35 long, so that products of three lengths neither over-
/// nor underflow, however large or small the scene is.
INLINE void make_shear(const LocalRay* ray, Shear* shear) {
    const float4 direction = as_float4(ray->direction);
    const uint4 bits = magnitudes(direction);
    const uint4 largest = largest_of(bits);
    const uint4 unit = min(power_bits(largest), (uint4)(0x7e800000u));
    // Without w: all lanes are equal where an instance's transform has left nothing of the direction.
    shear->z = last_lane(lanes4(bits == largest) & 7);
    shear->x = shear->z == 2 ? 0 : shear->z + 1;
    shear->y = shear->x == 2 ? 0 : shear->x + 1;
    shear->scale = power_of_two(clamp(ray->exponent, -126, 126));
    float from[4], along[4];
    vstore4(as_float4(ray->origin), 0, from);
    vstore4(direction * inverse_of_power_bits(unit) * shear->scale, 0, along);
    shear->origin_x = from[shear->x];
    shear->origin_y = from[shear->y];
    shear->origin_z = from[shear->z];
    shear->direction_x = along[shear->x];
    shear->direction_y = along[shear->y];
    shear->direction_z = along[shear->z];
    shear->minus_depth = -shear->direction_z * as_float(unit.x);
}

/// p q - r s, off by at most 2u of itself: its sign is exact unless products underflow (Kahan; Jeannerod et al. 2013).
INLINE real_t edge_function(real_t p, real_t q, real_t r, real_t s) {
    const real_t product = r * s;
    return fma(p, q, -product) - fma(r, s, -product);
}

/// Bit i of the result says that triangle i is hit with t_min < t <= t_max; then lane i of *hit holds where. A triangle
/// of three equal vertices, and one that the ray sees edge-on, is never hit: all three edge functions are 0 where 0 is
/// on all edges.
INLINE uint ray_triangle(const LocalRay* ray, const Shear* s, global const leaf_t* leaf, float t_min, float t_max,
                         TriangleHit* hit) {
    (void)ray;
    // From the vertices to the origin: straight from memory, without a load before. Products of two do not see the
    // sign.
    const real_t z0 = s->origin_z - COORDINATE(0, s->z);
    const real_t z1 = s->origin_z - COORDINATE(1, s->z);
    const real_t z2 = s->origin_z - COORDINATE(2, s->z);
    const real_t speed = s->direction_z;
    const real_t x0 = fma(s->origin_x - COORDINATE(0, s->x), speed, -(z0 * s->direction_x));
    const real_t x1 = fma(s->origin_x - COORDINATE(1, s->x), speed, -(z1 * s->direction_x));
    const real_t x2 = fma(s->origin_x - COORDINATE(2, s->x), speed, -(z2 * s->direction_x));
    const real_t y0 = fma(s->origin_y - COORDINATE(0, s->y), speed, -(z0 * s->direction_y));
    const real_t y1 = fma(s->origin_y - COORDINATE(1, s->y), speed, -(z1 * s->direction_y));
    const real_t y2 = fma(s->origin_y - COORDINATE(2, s->y), speed, -(z2 * s->direction_y));
    const real_t edge0 = edge_function(x2, y1, y2, x1);
    const real_t edge1 = edge_function(x0, y2, y0, x2);
    const real_t edge2 = edge_function(x1, y0, y1, x0);
    const real_t least = LESSER(LESSER(edge0, edge1), edge2);
    const real_t greatest = GREATER(GREATER(edge0, edge1), edge2);
    // Of one sign, zeros on either side; not all zero.
    const uint inside = HOLDING((least >= 0.0f) ^ (greatest <= 0.0f));
    if (inside == 0) return 0;

    const real_t sum = edge0 + edge1 + edge2;
    const real_t depth0 = z0 * s->scale, depth1 = z1 * s->scale, depth2 = z2 * s->scale;
    const real_t end = LESSER(LESSER(depth0, depth1), depth2) * sum;
    const real_t other_end = GREATER(GREATER(depth0, depth1), depth2) * sum;
    const real_t weighted = fma(depth0, sum, fma(edge1, depth1 - depth0, edge2 * (depth2 - depth0)));
    const real_t within = LESSER(GREATER(weighted, LESSER(end, other_end)), GREATER(end, other_end));
    const real_t inverse = 1.0f / sum;
    hit->t = within / (sum * s->minus_depth);
    hit->u = edge1 * inverse;
    hit->v = edge2 * inverse;
    return inside & HOLDING((fabs(sum) >= LEAST_AREA) & (hit->t > t_min) & (hit->t <= t_max));
}

#endif
