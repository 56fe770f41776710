// SPDX-License-Identifier: MIT
// Whether each ray hits anything. Macros: traverse/config.h.
//
// compile: LAYOUT=2 ORIENTED=0 LEVELS=1 FLATTENED=0 AREAS=0 INTERSECTOR=0 STATISTICS=0 STACK_SIZE=32 PORTABLE_LANES=1
// compile: LAYOUT=2 ORIENTED=1 LEVELS=1 FLATTENED=0 AREAS=0 INTERSECTOR=0 STATISTICS=0 STACK_SIZE=32 PORTABLE_LANES=1
// compile: LAYOUT=2 ORIENTED=0 LEVELS=2 FLATTENED=0 AREAS=0 INTERSECTOR=0 STATISTICS=0 STACK_SIZE=32 PORTABLE_LANES=0
// compile: LAYOUT=2 ORIENTED=1 LEVELS=2 FLATTENED=0 AREAS=0 INTERSECTOR=0 STATISTICS=0 STACK_SIZE=32 PORTABLE_LANES=0
// compile: LAYOUT=8 ORIENTED=0 LEVELS=1 FLATTENED=0 AREAS=0 INTERSECTOR=0 STATISTICS=0 STACK_SIZE=32 PORTABLE_LANES=1
// compile: LAYOUT=8 ORIENTED=0 LEVELS=2 FLATTENED=0 AREAS=0 INTERSECTOR=0 STATISTICS=0 STACK_SIZE=32 PORTABLE_LANES=0
// compile: LAYOUT=2 ORIENTED=0 LEVELS=1 FLATTENED=0 AREAS=1 INTERSECTOR=0 STATISTICS=0 STACK_SIZE=32 PORTABLE_LANES=0
// compile: LAYOUT=2 ORIENTED=0 LEVELS=1 FLATTENED=0 AREAS=0 INTERSECTOR=1 STATISTICS=0 STACK_SIZE=32 PORTABLE_LANES=1
// compile: LAYOUT=8 ORIENTED=0 LEVELS=2 FLATTENED=0 AREAS=0 INTERSECTOR=1 STATISTICS=0 STACK_SIZE=32 PORTABLE_LANES=0
// compile: LAYOUT=8 ORIENTED=0 LEVELS=1 FLATTENED=0 AREAS=1 INTERSECTOR=0 STATISTICS=0 STACK_SIZE=32 PORTABLE_LANES=1
#define ANY_HIT 1
#include "traverse/traversal.h"

/// Each work-item traces `slice` consecutive rays.
///
/// @pre  A valid, not empty tree within the stack bound of traversal_state.h, all of it in `sphere`. `top_nodes` and
///       `instances` are read for two levels only, `areas`, `area_nodes` and `area_items` for areas only; otherwise
///       they may be null.
/// @post hits[i] is 1 when rays[i] hits something, else 0.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void any_hit(TREE_PARAMETERS, global const Ray* rays, uint ray_count, uint slice, global uint* hits) {
    const uint first = (uint)get_global_id(0) * slice;
    const uint last = first < ray_count ? first + min(slice, ray_count - first) : first;
    const TracedTree tree = TRACED_TREE;
    for (uint i = first; i < last; ++i) {
        TraversalState state;
        Units units;
        trace(&rays[i], &tree, &units, &state);
        hits[i] = state.primitive != BOXWOOD_NONE ? 1 : 0;
    }
}
