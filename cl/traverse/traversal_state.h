// SPDX-License-Identifier: MIT
// What a traversal carries from node to node: the interval left, the best hit so far, the stack.
#ifndef BOXWOOD_TRAVERSE_TRAVERSAL_STATE_H
#define BOXWOOD_TRAVERSE_TRAVERSAL_STATE_H
#include "traverse/config.h"
#include "traverse/leaf.h"
#include "traverse/local_ray.h"
#if INTERSECTOR == 0
#include "traverse/ray_triangle.h"
#else
#include "traverse/moller_trumbore.h"
#endif

// A stack entry is the distance to a child's box and, in the lower half, the child reference. Distances are not
// negative, so entries compare as their distances do.
typedef ulong entry_t;
#define ENTRY_OF(distance, reference) ((ulong)as_uint(distance) << 32 | (reference))
#define ENTRY_DISTANCE(entry) as_float((uint)((entry) >> 32))

/// The nodes of one level and what its leaf references index: leaf_t below, InstanceRecord at the top.
typedef struct Arrays {
    global const node_t* nodes;
    global const char* leaves;
    uint leaf_bytes;
} Arrays;

// STACK_SIZE suffices when it is LAYOUT - 1 times the most nodes on a path from the root to a leaf's parent, both
// levels added up. Proof: the traversal is depth first, so the entries present are siblings of nodes on the path to the
// node at hand (in a bottom tree: siblings on the way down it, above those on the way to its instance); a node on the
// path leaves behind all of its children but the one that was entered, at most LAYOUT - 1, and it was itself taken off.

/// The stack itself is a variable of its own: an array inside would keep the whole struct out of registers.
typedef struct TraversalState {
    float t_min; ///< Boxes are met from there on.
#if AREAS
    float t_start; ///< Hits lie beyond it: at t_min or before.
#endif
    float t_max; ///< Where the search ends: t of the best hit, once there is one. Always finite.
    float u, v;
    uint primitive; ///< BOXWOOD_NONE until something is hit.
    uint instance;
#if STATISTICS
    RayStatistics statistics;
#endif
    uint top; ///< Entries on the stack.
} TraversalState;

/// Tests a leaf's triangles and keeps the best hit: the smallest t, then the lowest (instance, primitive).
INLINE void visit_leaf(const LocalRay* ray, const Shear* shear, global const leaf_t* leaf, uint instance,
                       TraversalState* state) {
#if STATISTICS
#if LAYOUT == 8
    const int4 used = (vload4(0, leaf->primitive) != BOXWOOD_NONE) & 1;
    state->statistics.primitives += used.x + used.y + used.z + used.w;
#else
    state->statistics.primitives += 1;
#endif
#endif
    TriangleHit hit;
#if AREAS
    const float t_min = state->t_start;
#else
    const float t_min = state->t_min;
#endif
    uint hits = ray_triangle(ray, shear, leaf, t_min, state->t_max, &hit);
#if ANY_HIT
    if (hits != 0) state->primitive = 0;
#elif LAYOUT == 8
    float t[4], u[4], v[4];
    if (hits == 0) return;
    vstore4(hit.t, 0, t);
    vstore4(hit.u, 0, u);
    vstore4(hit.v, 0, v);
    for (; hits != 0; hits &= hits - 1) {
        const uint lane = first_lane(hits);
        const uint primitive = leaf->primitive[lane];
        const bool lower = instance < state->instance || (instance == state->instance && primitive < state->primitive);
        if (t[lane] < state->t_max || (t[lane] == state->t_max && lower)) {
            state->t_max = t[lane];
            state->u = u[lane];
            state->v = v[lane];
            state->primitive = primitive;
            state->instance = instance;
        }
    }
#else
    const bool lower =
        instance < state->instance || (instance == state->instance && leaf->primitive < state->primitive);
    if (hits != 0 && (hit.t < state->t_max || lower)) {
        state->t_max = hit.t;
        state->u = hit.u;
        state->v = hit.v;
        state->primitive = leaf->primitive;
        state->instance = instance;
    }
#endif
}

#endif
