// SPDX-License-Identifier: MIT
// Triangles as traversal reads them: their vertices, so that two triangles have the same numbers at the edge they
// share.
#ifndef BOXWOOD_SHARED_TRIANGLE_H
#define BOXWOOD_SHARED_TRIANGLE_H
#include "shared/types.h"

BOXWOOD_SHARED_BEGIN

/// Leaf of the `binary` layout. A triangle of no area, one whose vertices are exactly collinear, is three times its
/// first vertex, which no ray hits.
typedef struct Triangle {
    float v0[3];
    uint primitive; ///< Index of the triangle within its mesh (within the flattened scene for one level).
    float v1[3];
    uint reserved1; ///< Zero.
    float v2[3];
    uint reserved2; ///< Zero.
} Triangle;
BOXWOOD_SHARED_SIZE(Triangle, 48)

/// Leaf of the `wide8` layout: one to four triangles as structure of arrays, ascending by primitive. Unused slots are
/// all zeros with primitive BOXWOOD_NONE; they can never be hit.
typedef struct Triangle4 {
    float v0_x[4];
    float v0_y[4];
    float v0_z[4];
    float v1_x[4];
    float v1_y[4];
    float v1_z[4];
    float v2_x[4];
    float v2_y[4];
    float v2_z[4];
    uint primitive[4];
} Triangle4;
BOXWOOD_SHARED_SIZE(Triangle4, 160)

BOXWOOD_SHARED_END
#endif
