// SPDX-License-Identifier: MIT
// How the triangle tests read a leaf: as float for the single triangles of LAYOUT 2, as float4 for the blocks of LAYOUT
// 8.
#ifndef BOXWOOD_TRAVERSE_LEAF_H
#define BOXWOOD_TRAVERSE_LEAF_H
#include "runtime/lanes.h"
#include "runtime/numerics.h"
#include "shared/triangle.h"

#if LAYOUT == 8
typedef Triangle4 leaf_t;
typedef float4 real_t;
/// Coordinate `axis` of vertex `corner`, of each triangle of `leaf`. Blocks are 160 bytes in a buffer aligned to more
/// than 16.
#define COORDINATE(corner, axis) (((global const float4*)leaf->v0_x + (axis))[3 * (corner)])
#define HOLDING(mask) lanes4(mask)
#elif LAYOUT == 2
typedef Triangle leaf_t;
typedef float real_t;
#define COORDINATE(corner, axis) ((leaf->v0 + (axis))[4 * (corner)])
#define HOLDING(mask) ((uint)(mask))
#else
#error "define LAYOUT (2 or 8)"
#endif

/// Where a ray meets the planes of the triangles of a leaf.
typedef struct TriangleHit {
    real_t t, u, v; ///< u and v are the weights of the second and third vertex.
} TriangleHit;

#endif
