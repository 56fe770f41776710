// SPDX-License-Identifier: MIT
#ifndef BOXWOOD_SHARED_VISITS_H
#define BOXWOOD_SHARED_VISITS_H
#include "shared/types.h"

BOXWOOD_SHARED_BEGIN

/// What one ray met of a binary tree with leaves of several primitives, the root included.
typedef struct RayVisits {
    uint nodes;             ///< Inner nodes whose box the whole ray meets.
    uint primitives;        ///< Primitives of the leaves whose box the whole ray meets.
    uint nodes_to_hit;      ///< Inner nodes that a search for the closest hit visits, nearest child first.
    uint primitives_to_hit; ///< Primitives of the leaves that it visits.
} RayVisits;
BOXWOOD_SHARED_SIZE(RayVisits, 16)

BOXWOOD_SHARED_END
#endif
