// SPDX-License-Identifier: MIT
// Closest hit of each ray. Macros: traverse/config.h.
//
// compile: LAYOUT=2 ORIENTED=0 LEVELS=1 FLATTENED=0 AREAS=0 INTERSECTOR=0 STATISTICS=1 STACK_SIZE=32 PORTABLE_LANES=1
// compile: LAYOUT=2 ORIENTED=1 LEVELS=1 FLATTENED=0 AREAS=0 INTERSECTOR=0 STATISTICS=1 STACK_SIZE=32 PORTABLE_LANES=1
// compile: LAYOUT=2 ORIENTED=0 LEVELS=1 FLATTENED=1 AREAS=0 INTERSECTOR=0 STATISTICS=0 STACK_SIZE=32 PORTABLE_LANES=1
// compile: LAYOUT=2 ORIENTED=1 LEVELS=1 FLATTENED=1 AREAS=0 INTERSECTOR=0 STATISTICS=0 STACK_SIZE=32 PORTABLE_LANES=1
// compile: LAYOUT=2 ORIENTED=0 LEVELS=2 FLATTENED=0 AREAS=0 INTERSECTOR=0 STATISTICS=0 STACK_SIZE=32 PORTABLE_LANES=0
// compile: LAYOUT=2 ORIENTED=1 LEVELS=2 FLATTENED=0 AREAS=0 INTERSECTOR=0 STATISTICS=0 STACK_SIZE=32 PORTABLE_LANES=0
// compile: LAYOUT=8 ORIENTED=0 LEVELS=1 FLATTENED=0 AREAS=0 INTERSECTOR=0 STATISTICS=0 STACK_SIZE=32 PORTABLE_LANES=1
// compile: LAYOUT=8 ORIENTED=0 LEVELS=1 FLATTENED=1 AREAS=0 INTERSECTOR=0 STATISTICS=1 STACK_SIZE=32 PORTABLE_LANES=1
// compile: LAYOUT=8 ORIENTED=0 LEVELS=2 FLATTENED=0 AREAS=0 INTERSECTOR=0 STATISTICS=1 STACK_SIZE=32 PORTABLE_LANES=0
// compile: LAYOUT=2 ORIENTED=0 LEVELS=1 FLATTENED=1 AREAS=1 INTERSECTOR=0 STATISTICS=0 STACK_SIZE=32 PORTABLE_LANES=0
// compile: LAYOUT=2 ORIENTED=0 LEVELS=1 FLATTENED=0 AREAS=0 INTERSECTOR=1 STATISTICS=0 STACK_SIZE=32 PORTABLE_LANES=1
// compile: LAYOUT=8 ORIENTED=0 LEVELS=2 FLATTENED=0 AREAS=0 INTERSECTOR=1 STATISTICS=0 STACK_SIZE=32 PORTABLE_LANES=0
// compile: LAYOUT=8 ORIENTED=0 LEVELS=1 FLATTENED=0 AREAS=1 INTERSECTOR=0 STATISTICS=1 STACK_SIZE=32 PORTABLE_LANES=1
#define ANY_HIT 0
#include "primitives/segments.h"
#include "traverse/traversal.h"

/// Each work-item traces `slice` consecutive rays; a ray's work is not known beforehand, so slices are short and many.
///
/// @pre  A valid, not empty tree within the stack bound of traversal_state.h, all of it in `sphere`. `top_nodes` and
///       `instances` are read for two levels only, `areas`, `area_nodes` and `area_items` for areas only,
///       `first_triangles` (instance_count + 1 entries) for flattened trees only, `statistics` is written for
///       statistics only; otherwise they may be null.
/// @post hits[i] is the answer for rays[i]: the smallest t, then the lowest (instance, primitive).
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void closest_hit(TREE_PARAMETERS, global const Ray* rays, uint ray_count, uint slice,
                 global const uint* first_triangles, uint instance_count, global Hit* hits,
                 global RayStatistics* statistics) {
    const uint first = (uint)get_global_id(0) * slice;
    const uint last = first < ray_count ? first + min(slice, ray_count - first) : first;
    const TracedTree tree = TRACED_TREE;
    for (uint i = first; i < last; ++i) {
        TraversalState state;
        Units units;
        trace(&rays[i], &tree, &units, &state);
#if FLATTENED
        if (state.primitive != BOXWOOD_NONE) {
            state.instance = segment_of(first_triangles, instance_count, state.primitive);
            state.primitive -= first_triangles[state.instance];
        }
#endif
        end_traversal(&rays[i], &units, &state, &hits[i]);
#if STATISTICS
        statistics[i] = state.statistics;
#endif
    }
}
