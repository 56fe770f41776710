// SPDX-License-Identifier: MIT
// Influence areas with trees of their own, and the index that finds those a point lies in.
#ifndef BOXWOOD_SHARED_AREA_H
#define BOXWOOD_SHARED_AREA_H
#include "shared/aabb.h"
#include "shared/influence.h"

BOXWOOD_SHARED_BEGIN

/// An influence area and its local tree, which holds every triangle that may be hit within the region.
typedef struct LocalArea {
    InfluenceRecord region; ///< Of a point area from the eye on: near is 0.
    Aabb box;               ///< Holds the region, rounding included.
    uint root;              ///< Of its tree, in the same node array as the global tree.
    float near;             ///< Where a point area's own rays begin, which its builder knew; 0 for plane areas.
} LocalArea;
BOXWOOD_SHARED_SIZE(LocalArea, 112)

// The value of AreaNode::axis for a node that is split along all three.
#define BOXWOOD_OCTANTS 3u

/// A cell of space. Inner nodes split it at `split[axis]` into two, or along all axes into eight; a point goes to the
/// child first + (p[axis] >= split[axis]), or + 1, 2 and 4 by the three axes. A leaf has the areas that meet its cell.
typedef struct AreaNode {
    float split[3]; ///< Zero where not used.
    uint axis;      ///< 0 to 2 or BOXWOOD_OCTANTS; 0 in leaves.
    uint first; ///< Inner: index of the first child, above this node's own. Leaf: its first entry of the list of areas.
    uint count; ///< Leaf: entries, ascending. Inner: BOXWOOD_NONE.
} AreaNode;
BOXWOOD_SHARED_SIZE(AreaNode, 24)

BOXWOOD_SHARED_END
#endif
