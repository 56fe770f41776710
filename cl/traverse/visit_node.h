// SPDX-License-Identifier: MIT
// One step down: tests the children of a node, goes on with one that is hit, and pushes the others on the stack.
#ifndef BOXWOOD_TRAVERSE_VISIT_NODE_H
#define BOXWOOD_TRAVERSE_VISIT_NODE_H
#include "runtime/prefetch.h"
#include "traverse/ray_box.h"
#include "traverse/ray_obb.h"
#include "traverse/traversal_state.h"

// Exchanges two entries when the first is farther, without a branch.
#define ORDER(near_entry, far_entry)                      \
    do {                                                  \
        const entry_t lower = min(near_entry, far_entry); \
        far_entry = max(near_entry, far_entry);           \
        near_entry = lower;                               \
    } while (0)

#if LAYOUT == 8

/// The entry of child `lane`, which will be visited soon: its memory is asked for now. Where any hit will do leaves
/// come first, as they may end the search.
INLINE entry_t child_entry(global const node_t* node, const float* distance, uint lane, const Arrays* arrays) {
    const uint reference = node->child[lane];
    const bool is_leaf = (reference & BOXWOOD_LEAF) != 0;
    const size_t leaf = (size_t)(reference & ~BOXWOOD_LEAF) * arrays->leaf_bytes;
    prefetch_256(is_leaf ? arrays->leaves + leaf : (global const char*)&arrays->nodes[reference]);
    return ENTRY_OF(ANY_HIT && is_leaf ? 0.0f : distance[lane], reference);
}

/// The nearest child met, the others left on the stack from far to near. BOXWOOD_NONE when none is met.
INLINE uint visit_node(const LocalRay* ray, const Arrays* arrays, uint index, TraversalState* state, entry_t* stack) {
    global const node_t* node = &arrays->nodes[index];
#if STATISTICS
    state->statistics.volumes += node->count;
#endif
    float8 entries;
    uint met = ray_box8(ray, node, state->t_min, state->t_max, &entries);
    if (met == 0) return BOXWOOD_NONE;
    uint lane = first_lane(met);
    met &= met - 1;
    if (met == 0) return node->child[lane];

    // Two and three children, by far the most frequent, are ordered without branches; more are inserted one by one.
    float distance[8];
    vstore8(entries, 0, distance);
    entry_t nearest = child_entry(node, distance, lane, arrays);
    lane = first_lane(met);
    met &= met - 1;
    entry_t farthest = child_entry(node, distance, lane, arrays);
    ORDER(nearest, farthest);
    const uint bottom = state->top;
    if (met != 0) {
        lane = first_lane(met);
        met &= met - 1;
        entry_t middle = child_entry(node, distance, lane, arrays);
        ORDER(middle, farthest);
        ORDER(nearest, middle);
        stack[state->top++] = farthest;
        for (; met != 0; met &= met - 1) {
            entry_t other = child_entry(node, distance, first_lane(met), arrays);
            ORDER(middle, other);
            ORDER(nearest, middle);
            uint place = state->top++;
            for (; place > bottom && stack[place - 1] < other; --place) stack[place] = stack[place - 1];
            stack[place] = other;
        }
        farthest = middle;
    }
    stack[state->top++] = farthest;
    return (uint)nearest;
}

#else

#if ORIENTED

INLINE bool ray_child(const LocalRay* ray, global const node_t* node, uint slot, const TraversalState* state,
                      float* entry) {
    global const float* volume = node->volume[slot];
    if ((node->child[slot] & BOXWOOD_ALIGNED) != 0)
        return ray_box(ray, (global const Aabb*)volume, state->t_min, state->t_max, entry);
    return ray_obb(ray, volume, state->t_min, state->t_max, entry);
}

INLINE uint child_reference(global const node_t* node, uint slot) { return node->child[slot] & ~BOXWOOD_ALIGNED; }

#else

INLINE bool ray_child(const LocalRay* ray, global const node_t* node, uint slot, const TraversalState* state,
                      float* entry) {
    return ray_box(ray, &node->bounds[slot], state->t_min, state->t_max, entry);
}

INLINE uint child_reference(global const node_t* node, uint slot) { return node->child[slot]; }

#endif

/// The nearer child met, the other left on the stack. BOXWOOD_NONE when none is met, as the empty box never is.
INLINE uint visit_node(const LocalRay* ray, const Arrays* arrays, uint index, TraversalState* state, entry_t* stack) {
    global const node_t* node = &arrays->nodes[index];
#if STATISTICS
    state->statistics.volumes += node->child[1] == BOXWOOD_NONE ? 1 : 2;
#endif
    float entry0, entry1;
    const bool met0 = ray_child(ray, node, 0, state, &entry0);
    const bool met1 = ray_child(ray, node, 1, state, &entry1);
    if (met0 && met1) {
        const bool swapped = entry1 < entry0;
        stack[state->top++] = ENTRY_OF(swapped ? entry0 : entry1, child_reference(node, swapped ? 0 : 1));
        return child_reference(node, swapped ? 1 : 0);
    }
    return met0 ? child_reference(node, 0) : met1 ? child_reference(node, 1) : BOXWOOD_NONE;
}

#endif
#endif
