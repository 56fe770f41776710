// SPDX-License-Identifier: MIT
// Ray against triangle, watertight (Woop, Benthin and Wald 2013): no ray passes between two triangles at the edge or vertex
// that they share. One triangle or four at a time; both layouts run the same text, on float or float4, so a triangle gives the same
// bits in both.
//
// The vertices are sheared, each by itself, into a plane across the ray, whose point there is 0. Edge functions are differences of
// two products with an exact sign (Kahan), so that in this plane the test is exact, edges and vertices included: triangles that
// share rounded vertices leave no gap.
//
// Why the answer does not depend on boxes. Let u = 2^-24, all that follows relative to the origin and the axes numbered as in
// Shear, so that |d_x|, |d_y| <= |d_z|. With x_i = fl(v_i.x - o.x), and z_i likewise, a vertex is sheared to
//     a_i = (d_z x_i - d_x z_i (1 + e_i)) (1 + f_i),    |e_i|, |f_i| <= u.
// The ray hits when weights w_i >= 0 of sum 1 have sum w_i a_i = 0 and the same along y. Let X = sum w_i x_i, Z = sum w_i z_i. As
// subtraction is monotone and the weights are convex, X lies between fl(low - o.x) and fl(high - o.x) for every box around the
// vertices: the very differences that the box test forms. And d_z X - d_x Z is
//     sum w_i d_x z_i e_i + sum w_i (d_z x_i - ...) (-f_i),
// the first at most u |d_x| (|Z| + D), D being the triangle's longest extent, as |z_i| <= |z_i - Z| + |Z|; the second, since the
// a_i average to 0, at most u/2 of their range, that is u |d_z| D. So along x the ray is at X at the distance Z / d_z, but for u of
// that distance and 2u D of length.
//
// The hit distance is t = (z_0 + (V (z_1 - z_0) + W (z_2 - z_0)) / (U + V + W)) / d_z. The quotient is at most D, off by at most 14u
// of D (edge functions 2u, their sum 4u, differences, products and sums 3u, a division 5u); the last sum rounds by u of itself, the
// division by 5u. So t is off by 6u of itself and 14u D of length, and with u from the shear and 16u D in all, |d_x| <= |d_z|:
//     every plane of a box around the triangle, moved outward by 16u D and its distance scaled by 1 -/+ 8u as box tests do, lies
//     on the right side of t.
// Boxes of triangles are moved by that (padded_triangle_box, bounds/triangle_box.h) and all other boxes are around these; BOX_SLACK
// is 16u, of which the box test's own roundings take 7u. Where d_x is zero, so is e_i's term, a_i = d_z x_i exactly in sign, and the
// box test compares the same differences with 0. The same holds for oriented boxes (ray_obb.h), and t is clamped to the triangle's
// own extent along the ray.
//
// Where a product underflows an edge function may become 0, or less exact, but never change its sign. Triangles whose area across
// the ray is below 2^-80 in units of traced length (2^-30 of the scene's radius, so 2^-140 of its square) are not hit; those
// that are have D >= 2^-40, and what 2^-149 does to their edge functions and to the sums above is far below u D.
#ifndef BOXWOOD_TRAVERSE_RAY_TRIANGLE_H
#define BOXWOOD_TRAVERSE_RAY_TRIANGLE_H
#include "traverse/leaf.h"
#include "traverse/local_ray.h"

#define LEAST_AREA 0x1p-80f

/// p q - r s, off by at most 2u of itself: its sign is exact unless products underflow (Kahan; Jeannerod et al. 2013).
INLINE real_t edge_function(real_t p, real_t q, real_t r, real_t s) {
    const real_t product = r * s;
    return fma(p, q, -product) - fma(r, s, -product);
}

/// Bit i of the result says that triangle i is hit with t_min < t <= t_max; then lane i of *crossing holds where. A triangle of
/// three equal vertices, and one that the ray sees edge-on, is never hit: all three edge functions are 0 where 0 is on all edges.
INLINE uint ray_triangle(const LocalRay* ray, global const leaf_t* leaf, float t_min, float t_max,
                         Crossing* crossing) {
    const Shear* s = &ray->shear;
    const real_t z0 = COORDINATE(0, s->z) - s->origin_z;
    const real_t z1 = COORDINATE(1, s->z) - s->origin_z;
    const real_t z2 = COORDINATE(2, s->z) - s->origin_z;
    const real_t speed = s->direction_z;
    const real_t x0 = fma(COORDINATE(0, s->x) - s->origin_x, speed, -(z0 * s->direction_x));
    const real_t x1 = fma(COORDINATE(1, s->x) - s->origin_x, speed, -(z1 * s->direction_x));
    const real_t x2 = fma(COORDINATE(2, s->x) - s->origin_x, speed, -(z2 * s->direction_x));
    const real_t y0 = fma(COORDINATE(0, s->y) - s->origin_y, speed, -(z0 * s->direction_y));
    const real_t y1 = fma(COORDINATE(1, s->y) - s->origin_y, speed, -(z1 * s->direction_y));
    const real_t y2 = fma(COORDINATE(2, s->y) - s->origin_y, speed, -(z2 * s->direction_y));
    const real_t edge0 = edge_function(x2, y1, y2, x1);
    const real_t edge1 = edge_function(x0, y2, y0, x2);
    const real_t edge2 = edge_function(x1, y0, y1, x0);
    const real_t least = LESSER(LESSER(edge0, edge1), edge2);
    const real_t greatest = GREATER(GREATER(edge0, edge1), edge2);
    // Of one sign, zeros on either side; not all zero.
    const uint inside = HOLDING((least >= 0.0f) ^ (greatest <= 0.0f));
    if (inside == 0) return 0;

    const real_t sum = edge0 + edge1 + edge2;
    const real_t near_z = LESSER(LESSER(z0, z1), z2), far_z = GREATER(GREATER(z0, z1), z2);
    const real_t along = fma(edge1, (z1 - z0) * s->scale, edge2 * ((z2 - z0) * s->scale)) / sum;
    const real_t depth = fma(z0, (real_t)(s->scale), along);
    crossing->t = LESSER(GREATER(depth, near_z * s->scale), far_z * s->scale) / s->depth;
    crossing->u = edge1 / sum;
    crossing->v = edge2 / sum;
    return inside &
           HOLDING((fabs(sum) >= LEAST_AREA) & (crossing->t > t_min) & (crossing->t <= t_max));
}

#endif
