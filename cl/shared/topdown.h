// SPDX-License-Identifier: MIT
#ifndef BOXWOOD_SHARED_TOPDOWN_H
#define BOXWOOD_SHARED_TOPDOWN_H
#include "shared/types.h"

BOXWOOD_SHARED_BEGIN

/// What steers a strategy without being compiled into it: the thresholds of TopDownOptions.
typedef struct Thresholds {
    float max_leaf_cost;
    float max_leaf_area;
    float max_leaf_hit_probability;
    uint max_leaf_primitives;
    uint max_levels;
    uint max_non_fallback_levels;
    float split_plane_quality;
    float acceptable_children;
    float excellent_children;
    uint reserved[3]; ///< Zero.
} Thresholds;
BOXWOOD_SHARED_SIZE(Thresholds, 48)

/// A node that a whole launch works on. Bounds are min x, y, z, unused, -max x, y, z, unused.
typedef struct LargeNode {
    float bounds[8];
    float centres[8]; ///< Of the primitives' centres.
    uint first;       ///< Position.
    uint count;
    uint level;
    uint flags; ///< NODE_...
    uint tree;
    uint first_chunk;
    uint left_count;
    uint cut; ///< 4 * bin + axis: primitives in bins below go left.
} LargeNode;
BOXWOOD_SHARED_SIZE(LargeNode, 96)

/// The root of a subtree that one work-item builds.
typedef struct SmallNode {
    uint first;
    uint count;
    uint level;
    uint flags;
    uint tree;
} SmallNode;
BOXWOOD_SHARED_SIZE(SmallNode, 20)

#define NODE_LEFT 1u  // a left child
#define NODE_OTHER 2u // its primitives are in the second of the two arrays
#define NODE_LEAF 4u  // a chosen leaf, or below one

BOXWOOD_SHARED_END
#endif
