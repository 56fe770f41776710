// SPDX-License-Identifier: MIT
#ifndef BOXWOOD_SHARED_RAY_H
#define BOXWOOD_SHARED_RAY_H
#include "shared/types.h"

BOXWOOD_SHARED_BEGIN

/// The points origin + t * direction with t_min < t <= t_max. The direction need not be normalised: t is in its units.
/// t_min >= 0; t_max may be infinite. A ray with a NaN or infinite component elsewhere, or a zero direction, hits
/// nothing.
typedef struct Ray {
    float origin[3];
    float t_min;
    float direction[3];
    float t_max;
} Ray;
BOXWOOD_SHARED_SIZE(Ray, 32)

/// What a ray met. On a miss: t = +infinity, u = v = 0, primitive = instance = BOXWOOD_NONE.
typedef struct Hit {
    float t;
    float u;        ///< Barycentric weight of the triangle's second vertex.
    float v;        ///< Barycentric weight of the triangle's third vertex.
    uint primitive; ///< Index of the triangle within the mesh of the instance.
    uint instance;  ///< Index into Scene::instances.
} Hit;
BOXWOOD_SHARED_SIZE(Hit, 20)

/// How much work one ray caused, over both levels.
typedef struct RayStatistics {
    uint volumes;    ///< Bounding volumes tested (a wide8 node counts its non-empty children).
    uint primitives; ///< Triangles tested.
    uint areas;      ///< 0: only the global tree was searched; 1: that of an influence area before; 2: that one only.
} RayStatistics;
BOXWOOD_SHARED_SIZE(RayStatistics, 12)

BOXWOOD_SHARED_END
#endif
