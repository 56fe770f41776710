// SPDX-License-Identifier: MIT
// Finds the influence area whose local tree a ray searches, and how far along the ray that search is valid.
#ifndef BOXWOOD_TRAVERSE_AREA_LOOKUP_H
#define BOXWOOD_TRAVERSE_AREA_LOOKUP_H
#include "influence/influence.h"
#include "shared/area.h"

/// The areas of a tree and their index; see shared/area.h.
typedef struct Areas {
    global const LocalArea* areas;
    global const AreaNode* nodes;
    global const uint* items;
} Areas;

/// The leaf of the index whose cell holds a point.
INLINE uint area_leaf(const Areas* a, float3 p) {
    uint node = 0;
    while (a->nodes[node].count == BOXWOOD_NONE) {
        global const AreaNode* n = &a->nodes[node];
        const uint axis = n->axis;
        const uint x = p.x >= n->split[0] ? 1 : 0;
        const uint y = p.y >= n->split[1] ? 1 : 0;
        const uint z = p.z >= n->split[2] ? 1 : 0;
        node = n->first + (axis == BOXWOOD_OCTANTS ? x | y << 1 | z << 2 : axis == 0 ? x : axis == 1 ? y : z);
    }
    return node;
}

/// Whether a point is in the region of an area; the box rejects most.
INLINE bool is_in_area(global const LocalArea* area, float3 p) {
    global const Aabb* box = &area->box;
    if (p.x < box->min[0] || p.x > box->max[0] || p.y < box->min[1] || p.y > box->max[1] || p.z < box->min[2] ||
        p.z > box->max[2])
        return false;
    return area_contains(&area->region, p);
}

/// The area to search first for the ray from `p`: of those that hold p and that the ray follows the one that it leaves
/// last, and of these the first. *exit is the distance up to which the ray is in it. BOXWOOD_NONE where there is none
/// with *exit above t_min.
INLINE uint find_area(const Areas* a, float3 p, float3 direction, float t_min, float* exit) {
    global const AreaNode* leaf = &a->nodes[area_leaf(a, p)];
    uint found = BOXWOOD_NONE;
    *exit = t_min;
    for (uint i = 0; i < leaf->count; ++i) {
        const uint candidate = a->items[leaf->first + i];
        global const LocalArea* area = &a->areas[candidate];
        if (!is_in_area(area, p) || !is_direction_affine(&area->region, p, direction)) continue;
        const float end = area_exit(&area->region, p, direction);
        if (end > *exit) {
            *exit = end;
            found = candidate;
        }
    }
    return found;
}

#endif
