// SPDX-License-Identifier: MIT
// The traversal layouts. A child reference is an index into the same node array, or BOXWOOD_LEAF | leaf index.
#ifndef BOXWOOD_SHARED_NODE_H
#define BOXWOOD_SHARED_NODE_H
#include "shared/aabb.h"

BOXWOOD_SHARED_BEGIN

/// `binary`: both child volumes in the parent. A tree over one primitive has an empty second child (empty box,
/// reference BOXWOOD_NONE).
typedef struct BinaryNode {
    Aabb bounds[2];
    uint child[2];
    uint reserved[2]; ///< Zero.
} BinaryNode;
BOXWOOD_SHARED_SIZE(BinaryNode, 64)

/// `binary` with oriented volumes. Where a child's reference has BOXWOOD_ALIGNED, the first six floats of its volume
/// are an Aabb (min, max) and the others are zero; else they are an Obb: center, extent, and its axes by columns, so
/// that the three slabs are the lanes of a vector. A tree over one primitive has an empty, aligned second child with
/// the reference BOXWOOD_NONE. Indices are below 2^30.
typedef struct OrientedNode {
    float volume[2][15];
    uint child[2];
} OrientedNode;
BOXWOOD_SHARED_SIZE(OrientedNode, 128)

/// `wide8`: eight children as structure of arrays. The `count` children come first; the other slots hold empty
/// boxes and BOXWOOD_NONE.
typedef struct Wide8Node {
    float min_x[8];
    float max_x[8];
    float min_y[8];
    float max_y[8];
    float min_z[8];
    float max_z[8];
    uint child[8];
    uint count;       ///< 1..8; 0 only in nodes that nothing refers to
    uint reserved[7]; ///< Zero.
} Wide8Node;
BOXWOOD_SHARED_SIZE(Wide8Node, 256)

BOXWOOD_SHARED_END
#endif
