// SPDX-License-Identifier: MIT
// Counts what rays meet of a binary tree before it has a layout, with the leaves that a builder chose: over all boxes
// on the ray, as cost functions do, and over those that the search for the closest hit visits.
//
// STACK_SIZE  at least 1 more than the most nodes on a path from the root to a leaf's parent
// PORTABLE_LANES  see runtime/lanes.h
// compile: STACK_SIZE=32 PORTABLE_LANES=1
// compile: STACK_SIZE=256 PORTABLE_LANES=0
#define ANY_HIT 0
#define LAYOUT 2
#define ORIENTED 0
#define LEVELS 1
#define FLATTENED 0
#define AREAS 0
#define INTERSECTOR 0
#define STATISTICS 0
#include "traverse/traversal.h"
#include "shared/visits.h"

/// Nodes by topology index: inner nodes below `count`, single primitives above.
typedef struct MarkedTree {
    global const uint2* children;
    global const uint* far_ends;
    global const uint* leaves;
    global const Aabb* volumes;
    global const Triangle* triangles; ///< By sorted position.
    uint count;
} MarkedTree;

/// Whether `node` is a leaf; then the positions [*first, *last] of its primitives.
INLINE bool is_leaf(const MarkedTree* tree, uint node, uint* first, uint* last) {
    if (node >= tree->count) {
        *first = *last = node - tree->count;
        return true;
    }
    if (tree->leaves[node] == 0) return false;
    const uint far_end = tree->far_ends[node];
    *first = min(node, far_end);
    *last = max(node, far_end);
    return true;
}

INLINE void meet_all(const MarkedTree* tree, const LocalRay* ray, uint root, const TraversalState* state,
                     entry_t* stack, RayVisits* visits) {
    uint top = 0;
    stack[top++] = root;
    while (top != 0) {
        const uint node = (uint)stack[--top];
        float entry;
        uint first, last;
        if (!ray_box(ray, &tree->volumes[node], state->t_min, state->t_max, &entry)) continue;
        if (is_leaf(tree, node, &first, &last)) {
            visits->primitives += last - first + 1;
            continue;
        }
        visits->nodes += 1;
        const uint2 below = tree->children[node];
        stack[top++] = below.x;
        stack[top++] = below.y;
    }
}

/// The nearer child met is next; of equally near ones the left.
INLINE uint nearer_child(const MarkedTree* tree, const LocalRay* ray, uint node, TraversalState* state,
                         entry_t* stack) {
    const uint2 below = tree->children[node];
    float left_entry, right_entry;
    const bool left = ray_box(ray, &tree->volumes[below.x], state->t_min, state->t_max, &left_entry);
    const bool right = ray_box(ray, &tree->volumes[below.y], state->t_min, state->t_max, &right_entry);
    if (left && right) {
        const bool left_first = left_entry <= right_entry;
        stack[state->top++] = left_first ? ENTRY_OF(right_entry, below.y) : ENTRY_OF(left_entry, below.x);
        return left_first ? below.x : below.y;
    }
    if (left) return below.x;
    return right ? below.y : BOXWOOD_NONE;
}

INLINE void search(const MarkedTree* tree, const LocalRay* ray, uint root, TraversalState* state, entry_t* stack,
                   RayVisits* visits) {
    float entry;
    Shear shear;
    make_shear(ray, &shear);
    uint node = ray_box(ray, &tree->volumes[root], state->t_min, state->t_max, &entry) ? root : BOXWOOD_NONE;
    while (node != BOXWOOD_NONE) {
        uint first, last;
        if (is_leaf(tree, node, &first, &last)) {
            visits->primitives_to_hit += last - first + 1;
            for (uint i = first; i <= last; ++i) visit_leaf(ray, &shear, &tree->triangles[i], 0, state);
            node = next_reference(state, stack, 0);
        } else {
            visits->nodes_to_hit += 1;
            node = nearer_child(tree, ray, node, state, stack);
            if (node == BOXWOOD_NONE) node = next_reference(state, stack, 0);
        }
    }
}

/// @pre  One tree of `count` >= 1 primitives; STACK_SIZE holds its depth.
/// @post all_visits[i] and hits[i] are those of rays[i]; hits as closest_hit gives them.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void ray_visits(global const uint2* children, global const uint* far_ends, global const uint* leaves,
                global const Aabb* volumes, global const Triangle* triangles, uint count, global const Ray* rays,
                uint ray_count, uint slice, SceneSphere sphere, global RayVisits* all_visits, global Hit* hits) {
    const uint begin = (uint)get_global_id(0) * slice;
    const uint end = begin < ray_count ? begin + min(slice, ray_count - begin) : begin;
    const MarkedTree tree = {children, far_ends, leaves, volumes, triangles, count};
    const uint root = count == 1 ? 1 : 0;
    for (uint i = begin; i < end; ++i) {
        TraversalState state;
        entry_t stack[STACK_SIZE];
        LocalRay ray;
        Units units;
        RayVisits visits = {0, 0, 0, 0};
        if (begin_traversal(&rays[i], &sphere, &ray, &units, &state)) {
            meet_all(&tree, &ray, root, &state, stack, &visits);
            search(&tree, &ray, root, &state, stack, &visits);
        }
        all_visits[i] = visits;
        end_traversal(&rays[i], &units, &state, &hits[i]);
    }
}
