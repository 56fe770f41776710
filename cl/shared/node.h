// SPDX-License-Identifier: MIT
// The two traversal layouts. A child reference is an index into the same node array, or BOXWOOD_LEAF | leaf index.
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
    uint count; ///< 1..8; 0 only in nodes that nothing refers to
    uint reserved[7]; ///< Zero.
} Wide8Node;
BOXWOOD_SHARED_SIZE(Wide8Node, 256)

BOXWOOD_SHARED_END
#endif
