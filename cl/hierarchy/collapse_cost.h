// SPDX-License-Identifier: MIT
// Arithmetic that the collapse's cost pass and its choices share, so that both see the same numbers.
#ifndef BOXWOOD_HIERARCHY_COLLAPSE_COST_H
#define BOXWOOD_HIERARCHY_COLLAPSE_COST_H
#include "hierarchy/forest.h"
#include "shared/aabb.h"

#if !defined(LEAF_SIZE) || !defined(NODE_COST) || !defined(LEAF_COST)
#error "define LEAF_SIZE, NODE_COST and LEAF_COST"
#endif

/// Half the surface area of a box after division of its extents by `unit`.
inline float half_area(global const Aabb* box, float unit) {
    const float x = (box->max[0] - box->min[0]) / unit;
    const float y = (box->max[1] - box->min[1]) / unit;
    const float z = (box->max[2] - box->min[2]) / unit;
    return x * y + y * z + z * x;
}

/// Chance that a ray that hits `parent` hits `a` and `b`, by surface area. A parent without area counts as always hit.
inline float2 hit_chances(global const Aabb* parent, global const Aabb* a, global const Aabb* b) {
    const float unit = max(max(parent->max[0] - parent->min[0], parent->max[1] - parent->min[1]),
                           parent->max[2] - parent->min[2]);
    if (!(unit > 0.0f)) return (float2)(1.0f, 1.0f);
    const float whole = half_area(parent, unit);
    if (!(whole > 0.0f)) return (float2)(1.0f, 1.0f);
    return (float2)(half_area(a, unit) / whole, half_area(b, unit) / whole);
}

#endif
