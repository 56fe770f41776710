// SPDX-License-Identifier: MIT
#ifndef BOXWOOD_SHARED_AABB_H
#define BOXWOOD_SHARED_AABB_H
#include "types.h"

BOXWOOD_SHARED_BEGIN

/// Axis-aligned bounding box, closed. The empty box has min = +infinity and max = -infinity.
typedef struct Aabb {
    float min[3];
    float max[3];
} Aabb;
BOXWOOD_SHARED_SIZE(Aabb, 24)

BOXWOOD_SHARED_END
#endif
