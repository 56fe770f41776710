// SPDX-License-Identifier: MIT
// The traversal of one ray, closest hit or any hit, one level or two: depth first, nearest child first, with an
// explicit stack (dissertation 3.4 and 3.6.3; lecture slides on closest-hit and boolean intersection).
#ifndef BOXWOOD_TRAVERSE_TRAVERSAL_H
#define BOXWOOD_TRAVERSE_TRAVERSAL_H
#include "traverse/begin_ray.h"
#include "traverse/visit_node.h"
#if AREAS
#include "traverse/area_lookup.h"
#endif

/// True once nothing can change the answer any more.
INLINE bool is_settled(const TraversalState* state) { return ANY_HIT && state->primitive != BOXWOOD_NONE; }

/// Takes entries off the stack, down to `bottom`, until one is not beyond the best hit, if the closest is asked for;
/// BOXWOOD_NONE when none is left.
INLINE uint next_reference(TraversalState* state, const entry_t* stack, uint bottom) {
    while (state->top > bottom) {
        const entry_t entry = stack[--state->top];
        if (ANY_HIT || ENTRY_DISTANCE(entry) <= state->t_max) return (uint)entry;
    }
    return BOXWOOD_NONE;
}

/// From `reference` on to the next leaf, or BOXWOOD_NONE. That has the leaf bit, so the inner loop ends where nothing
/// is met.
INLINE uint next_leaf(const LocalRay* ray, const Arrays* arrays, uint reference, TraversalState* state, entry_t* stack,
                      uint bottom) {
    while (reference != BOXWOOD_NONE) {
        while ((reference & BOXWOOD_LEAF) == 0) reference = visit_node(ray, arrays, reference, state, stack);
        if (reference != BOXWOOD_NONE) return reference;
        reference = next_reference(state, stack, bottom);
    }
    return BOXWOOD_NONE;
}

/// Everything below node `reference`.
INLINE void traverse_bottom(const LocalRay* ray, const Arrays* arrays, uint reference, uint instance,
                            TraversalState* state, entry_t* stack) {
    global const leaf_t* leaves = (global const leaf_t*)arrays->leaves;
    const uint bottom = state->top;
    // Apart from the loop, as many rays meet no leaf, and what triangles need of the ray takes as long as some nodes.
    reference = next_leaf(ray, arrays, reference, state, stack, bottom);
    if (reference == BOXWOOD_NONE) return;
    Shear shear;
    make_shear(ray, &shear);
    do {
        visit_leaf(ray, &shear, &leaves[reference & ~BOXWOOD_LEAF], instance, state);
        if (is_settled(state)) return;
        reference = next_leaf(ray, arrays, next_reference(state, stack, bottom), state, stack, bottom);
    } while (reference != BOXWOOD_NONE);
}

#if LEVELS == 2

INLINE void traverse_top(const LocalRay* ray, const Arrays* top, const Arrays* arrays, TraversalState* state,
                         entry_t* stack) {
    global const InstanceRecord* instances = (global const InstanceRecord*)top->leaves;
    uint reference = 0;
    do {
        while ((reference & BOXWOOD_LEAF) == 0) reference = visit_node(ray, top, reference, state, stack);
        if (reference != BOXWOOD_NONE) {
            const uint instance = reference & ~BOXWOOD_LEAF;
            LocalRay local_ray;
            to_object_space(ray, &instances[instance], &local_ray);
            traverse_bottom(&local_ray, arrays, instances[instance].root, instance, state, stack);
        }
        if (is_settled(state)) return;
        reference = next_reference(state, stack, 0);
    } while (reference != BOXWOOD_NONE);
}

#endif

#if AREAS

// 0: takes every hit in a local tree for the closest, as the paper does, which is wrong beyond the region; for
// measurements.
#ifndef EXIT_RULE
#define EXIT_RULE 1
#endif

/// Searches the local tree of an area that holds the origin, then what is left with the global tree.
///
/// Closest hits, exactly. While a ray is in a region, which is convex, it meets only triangles that have a point there,
/// and the local tree has all of these and those so near that rounding could bring them in
/// (cl/build/area_triangles.cl). So every triangle that the ray hits at t <= exit is in the local tree. The local
/// search covers (t_min, exit], ends included as ray_triangle() has them: a hit there is the smallest t of all
/// triangles, and the lowest of all at that t. Without one nothing is hit up to the exit, and the global tree is
/// searched for boxes that the ray meets in [exit, t_max]. A local hit beyond the exit would be none of the two: a
/// triangle without a point in the region may be nearer.
///
/// A triangle that the ray grazes beyond the exit may have a computed t before it: t rounds by the distance over the
/// sine of the angle between them. Its box reaches beyond the exit, so it is met, and its hit counts, as t_start has
/// not moved.
///
/// Any hit: a triangle of the local tree is one of the scene, so a hit in it is an answer wherever it lies.
///
/// A ray from far away searches the global tree alone.
INLINE void traverse_areas(const LocalRay* ray, const Units* units, const Areas* areas, const Arrays* arrays,
                           TraversalState* state, entry_t* stack) {
    const float t_max = state->t_max;
    const float length = units->length;
    float exit = 0.0f;
    uint area = BOXWOOD_NONE;
    if (units->moved.high == 0.0f) {
        area = find_area(areas, ray->origin, ray->direction / length, state->t_min * length, &exit);
        exit /= length;
    }
    uint searches = area == BOXWOOD_NONE ? 1 : 2;
    uint root = area == BOXWOOD_NONE ? 0 : areas->areas[area].root;
#if EXIT_RULE && !ANY_HIT
    if (searches == 2) state->t_max = fmin(t_max, exit);
#endif
#if STATISTICS
    state->statistics.areas = searches - 1;
#endif
    while (true) {
        traverse_bottom(ray, arrays, root, 0, state, stack);
        if (--searches == 0) return;
        if (state->primitive != BOXWOOD_NONE || exit >= t_max) break;
        state->t_min = exit;
        state->t_max = t_max;
        root = 0;
    }
#if STATISTICS
    state->statistics.areas = 2;
#endif
}

#endif

/// Sets up `state` and the ray in world space. False when the ray cannot hit anything.
INLINE bool begin_traversal(global const Ray* source, const SceneSphere* sphere, LocalRay* ray, Units* units,
                            TraversalState* state) {
    state->primitive = BOXWOOD_NONE;
    state->instance = BOXWOOD_NONE;
    state->u = 0.0f;
    state->v = 0.0f;
    state->top = 0;
#if STATISTICS
    state->statistics.volumes = 0;
    state->statistics.primitives = 0;
    state->statistics.areas = 0;
#endif
    if (!begin_ray(source, sphere, ray, units, &state->t_min, &state->t_max)) return false;
#if AREAS
    state->t_start = state->t_min;
#endif
    return true;
}

/// A tree in its layout; what its kind does not have is not read, and may be null.
typedef struct TracedTree {
    Arrays bottom;
    Arrays top; ///< Two levels: its leaves are InstanceRecords.
#if AREAS
    Areas areas;
#endif
    SceneSphere sphere; ///< Around everything.
} TracedTree;

// The first parameters of a kernel that traces, and the TracedTree of them.
#define TREE_PARAMETERS                                                                                           \
    global const node_t *nodes, global const leaf_t *leaves, global const node_t *top_nodes,                      \
        global const InstanceRecord *instances, global const LocalArea *areas, global const AreaNode *area_nodes, \
        global const uint *area_items, SceneSphere sphere
#if AREAS
#define TRACED_AREAS {areas, area_nodes, area_items},
#else
#define TRACED_AREAS
#endif
#define TRACED_TREE                                                                                 \
    {                                                                                               \
        {nodes, (global const char*)leaves, sizeof(leaf_t)},                                        \
            {top_nodes, (global const char*)instances, sizeof(InstanceRecord)}, TRACED_AREAS sphere \
    }

/// Searches the whole tree: state->primitive is BOXWOOD_NONE, or what was hit.
INLINE void trace(global const Ray* source, const TracedTree* tree, Units* units, TraversalState* state) {
    entry_t stack[STACK_SIZE];
    LocalRay ray;
    if (!begin_traversal(source, &tree->sphere, &ray, units, state)) return;
#if LEVELS == 2
    traverse_top(&ray, &tree->top, &tree->bottom, state, stack);
#elif AREAS
    traverse_areas(&ray, units, &tree->areas, &tree->bottom, state, stack);
#else
    traverse_bottom(&ray, &tree->bottom, 0, 0, state, stack);
#endif
}

/// The hit of a ray that was begun, or the miss of one that could not.
INLINE void end_traversal(global const Ray* source, const Units* units, const TraversalState* state, global Hit* hit) {
    const bool is_hit = state->primitive != BOXWOOD_NONE;
    hit->t = is_hit ? caller_distance(source, units, state->t_max) : INFINITY;
    hit->u = state->u;
    hit->v = state->v;
    hit->primitive = state->primitive;
    hit->instance = state->instance;
}

#endif
