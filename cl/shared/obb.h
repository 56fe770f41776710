// SPDX-License-Identifier: MIT
#ifndef BOXWOOD_SHARED_OBB_H
#define BOXWOOD_SHARED_OBB_H
#include "shared/types.h"

// Floats that a node's moments take while boxes are fitted, and extreme points kept of a refined node.
#define BOXWOOD_MOMENT_FLOATS 12
#define BOXWOOD_EXTREMES 32

BOXWOOD_SHARED_BEGIN

/// Oriented bounding box, closed: the points p with |axis_k . (p - center)| <= extent[k] for k = 0, 1, 2, the axes
/// being the rows of `axes`. A fit gives orthonormal, right-handed rows; after an affine map (dissertation 3.1.4) they
/// need be neither, and the box is a parallelepiped.
///
/// The map M = T R S of the dissertation (3.1.1), from the cube [-0.5, 0.5]^3, has the columns 2 extent[k] times those
/// of the inverse of `axes`, and `center`. The inverse of M itself is not stored: it is infinite for a flat box, such
/// as that of a triangle, and it would lose the digits of a small box far from the origin, which p - center keeps.
typedef struct Obb {
    float center[3];
    /// Half the lengths of the edges (`half` is a word of OpenCL). Not negative. All -infinity: the empty box.
    float extent[3];
    float axes[9]; ///< Three rows.
    uint aligned;  ///< 1: this is the node's AABB (axes are the identity), which was not larger; 0: a fitted box.
} Obb;
BOXWOOD_SHARED_SIZE(Obb, 64)

BOXWOOD_SHARED_END
#endif
