// SPDX-License-Identifier: MIT
// One step down: tests the children of a node, puts all that are met but one on the stack, and goes on with that one.
#ifndef BOXWOOD_TRAVERSE_VISIT_NODE_H
#define BOXWOOD_TRAVERSE_VISIT_NODE_H
#include "traverse/ray_box.h"
#include "traverse/walk.h"

#if LAYOUT == 8

/// The nearest child met, the others left on the stack from far to near. BOXWOOD_NONE when none is met. For any hit the
/// order does not matter.
inline uint visit_node(const LocalRay* ray, global const node_t* node, Walk* walk) {
#if STATISTICS
    walk->statistics.volumes += node->count;
#endif
    float8 entries;
    uint met = ray_box8(ray, node, walk->t_min, walk->t_max, &entries);
    if (met == 0) return BOXWOOD_NONE;
    uint lane = first_lane(met);
    met &= met - 1;
    const uint first = node->child[lane];
    if (met == 0) return first;
#if ANY_HIT
    for (; met != 0; met &= met - 1) walk->stack[walk->top++] = node->child[first_lane(met)];
    return first;
#else
    float distance[8];
    vstore8(entries, 0, distance);
    const uint bottom = walk->top;
    entry_t nearest = ENTRY_OF(distance[lane], first);
    for (; met != 0; met &= met - 1) {
        lane = first_lane(met);
        const entry_t other = ENTRY_OF(distance[lane], node->child[lane]);
        const entry_t farther = max(nearest, other);
        nearest = min(nearest, other);
        uint place = walk->top++;
        for (; place > bottom && walk->stack[place - 1] < farther; --place) walk->stack[place] = walk->stack[place - 1];
        walk->stack[place] = farther;
    }
    return (uint)nearest;
#endif
}

#else

inline uint visit_node(const LocalRay* ray, global const node_t* node, Walk* walk) {
#if STATISTICS
    walk->statistics.volumes += node->child[1] == BOXWOOD_NONE ? 1 : 2;
#endif
    float entry0, entry1;
    const bool met0 = ray_box(ray, &node->bounds[0], walk->t_min, walk->t_max, &entry0);
    const bool met1 = ray_box(ray, &node->bounds[1], walk->t_min, walk->t_max, &entry1);
    if (met0 && met1) {
        const bool swapped = entry1 < entry0;
        walk->stack[walk->top++] = ENTRY_OF(swapped ? entry0 : entry1, node->child[swapped ? 0 : 1]);
        return node->child[swapped ? 1 : 0];
    }
    return met0 ? node->child[0] : met1 ? node->child[1] : BOXWOOD_NONE;
}

#endif
#endif
