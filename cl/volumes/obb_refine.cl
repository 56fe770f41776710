// SPDX-License-Identifier: MIT
// Oriented boxes, a better frame for the large nodes, which hold most of the volume of a tree (dissertation 3.5 stops
// at PCA). Of each node only the extreme points along fixed directions are kept, as in a k-DOP (Larsson and Kallberg
// 2011, for their use), since the extremes of a node are among those of its children. A frame is then turned ROUNDS
// times about each of its axes to where the box around the extremes is smallest. The start is the better of the
// eigenvectors of their covariance and the axes of the world.
//
//   refined_nodes  which nodes have at least SMALLEST primitives
//   refined_slots  lists them
//   node_extremes  their extreme points, bottom-up
//   refine_frames  their axes
//
// SMALLEST  primitives, see above
// LANES     is 1
// POINTS_PER_PRIMITIVE, MEASURE_AREA, FALLBACK  see volumes/obb_node.h, bounds/oriented_box.h
// compile: SMALLEST=256 POINTS_PER_PRIMITIVE=3 LANES=1 MEASURE_AREA=0 FALLBACK=1
// compile: SMALLEST=2 POINTS_PER_PRIMITIVE=8 LANES=1 MEASURE_AREA=1 FALLBACK=0
#include "bounds/eigen.h"
#include "volumes/obb_node.h"
#include "volumes/turn_steps.h"
#include "runtime/handoff.h"

#define EXTREMES BOXWOOD_EXTREMES // two for each direction
// Turns about each of the three axes.
#define ROUNDS 2

// Points taken of a primitive: neighbours share a triangle's vertices, but nothing else has the corners of an instance.
#define SAMPLES (POINTS_PER_PRIMITIVE == 3 ? 1 : POINTS_PER_PRIMITIVE)

// The axes of a cube through its faces, edges and corners, and three more to fill two vectors; no direction is farther
// than 28 degrees from one of them or its opposite. Their lengths do not matter.
#define DIRECTIONS_X (float16)(1, 0, 0, 1, 1, 1, 1, 0, 0, 1, 1, 1, 1, 0, 2, 1)
#define DIRECTIONS_Y (float16)(0, 1, 0, 1, -1, 0, 0, 1, 1, 1, 1, -1, -1, 1, 0, 2)
#define DIRECTIONS_Z (float16)(0, 0, 1, 0, 0, 1, -1, 1, -1, 1, -1, 1, -1, 2, 1, 0)

/// The ends found so far along the directions, and the points that they are at.
typedef struct Ends {
    float16 low, high;
    uint16 lowest, highest;
} Ends;

INLINE void load_space_point(const Nodes* nodes, const Space* space, uint point, Vector* p) {
    const Vector world = {nodes->points[point], nodes->points[nodes->stride + point],
                          nodes->points[2 * (size_t)nodes->stride + point]};
    to_space(space, &world, p);
}

/// Takes a point in. Of equally extreme ones the first stays.
INLINE void add_end(const Nodes* nodes, const Space* space, uint point, Ends* ends) {
    Vector p;
    load_space_point(nodes, space, point, &p);
    const float16 along = fma(DIRECTIONS_X, p.x, fma(DIRECTIONS_Y, p.y, DIRECTIONS_Z * p.z));
    const int16 lower = along<ends->low, higher = along> ends->high;
    ends->low = select(ends->low, along, lower);
    ends->high = select(ends->high, along, higher);
    ends->lowest = select(ends->lowest, (uint16)(point), lower);
    ends->highest = select(ends->highest, (uint16)(point), higher);
}

/// What the walk over the nodes needs.
typedef struct Extremes {
    Nodes nodes;
    global const uint* far_ends;
    global const uint* slots;      ///< The exclusive scan of `refined`.
    global const uint* slot_nodes; ///< The node of each slot.
    global uint* points;           ///< EXTREMES for each slot.
} Extremes;

/// Takes in what is kept of the points below a child: its extremes, or SAMPLES points of each primitive when it has
/// none.
INLINE void add_child(const Extremes* data, const Space* space, uint child, Ends* ends) {
    if (node_size(child, data->far_ends, data->nodes.count) >= SMALLEST) {
        global const uint* source = data->points + EXTREMES * (size_t)data->slots[child];
        for (uint k = 0; k < EXTREMES; ++k) add_end(&data->nodes, space, source[k], ends);
    } else {
        const uint2 range = range_of(child, data->far_ends, data->nodes.count);
        for (uint i = range.x; i <= range.y; ++i)
            for (uint k = 0; k < SAMPLES; ++k) add_end(&data->nodes, space, i * POINTS_PER_PRIMITIVE + k, ends);
    }
}

INLINE uint refined_children(const Extremes* data, uint2 children) {
    const uint count = data->nodes.count;
    return (node_size(children.x, data->far_ends, count) >= SMALLEST ? 1u : 0u) +
           (node_size(children.y, data->far_ends, count) >= SMALLEST ? 1u : 0u);
}

INLINE void find_extremes(const Extremes* data, uint slot, uint2 children) {
    const uint node = data->slot_nodes[slot];
    Space space;
    space_of(data->nodes.aabbs, &node, &space);
    Ends ends = {(float16)(INFINITY), (float16)(-INFINITY), (uint16)(0), (uint16)(0)};
    add_child(data, &space, children.x, &ends);
    add_child(data, &space, children.y, &ends);
    vstore16(ends.lowest, 0, data->points + EXTREMES * (size_t)slot);
    vstore16(ends.highest, 1, data->points + EXTREMES * (size_t)slot);
}

/// refined[i] = 1 for the inner nodes that are refined, else 0.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void refined_nodes(global const uint2* children, global const uint* far_ends, global uint* refined, uint count,
                   uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    const uint end = begin < count ? min(begin + slice, count) : begin;
    for (uint i = begin; i < end; ++i)
        refined[i] = children[i].x != BOXWOOD_NONE && range_size(i, far_ends) >= SMALLEST ? 1 : 0;
}

/// slot_nodes, see Extremes.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void refined_slots(global const uint* refined, global const uint* slots, global uint* slot_nodes, uint count,
                   uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    const uint end = begin < count ? min(begin + slice, count) : begin;
    for (uint i = begin; i < end; ++i)
        if (refined[i]) slot_nodes[slots[i]] = i;
}

/// extremes, see Extremes. Work begins at the nodes of one slice of slots that have no refined child, and goes up from
/// there.
/// Before: aabbs of all nodes, the sorted points; arrivals, one per slot, are 0.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void node_extremes(global const uint2* children, global const uint* parents, global const uint* far_ends,
                   global handoff_t* arrivals, global const Aabb* aabbs, global const float* points, uint stride,
                   global const uint* slots, global const uint* slot_nodes, global uint* extremes, uint count,
                   uint slot_count, uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    const uint end = begin < slot_count ? min(begin + slice, slot_count) : begin;
    const Extremes data = {{aabbs, points, stride, 0, count}, far_ends, slots, slot_nodes, extremes};
    for (uint i = begin; i < end; ++i) {
        uint node = slot_nodes[i];
        if (refined_children(&data, children[node]) != 0) continue;
        find_extremes(&data, slots[node], children[node]);
        for (node = parents[node]; node != BOXWOOD_NONE; node = parents[node]) {
            if (refined_children(&data, children[node]) == 2 && !handoff_is_second(arrivals + slots[node])) break;
            find_extremes(&data, slots[node], children[node]);
        }
    }
}

/// What is made small: the area of the rectangle that is turned, or the surface of the box over it.
INLINE float8 cost_of(float8 width, float8 depth, float height) {
#if MEASURE_AREA
    return fma(width, depth, height * (width + depth));
#else
    (void)height;
    return width * depth;
#endif
}

/// The cost of the box over the points u, v turned by eight angles.
INLINE float8 turned_cost(const float* u, const float* v, float8 cosine, float8 sine, float height) {
    float8 low_a = INFINITY, low_b = INFINITY, high_a = -INFINITY, high_b = -INFINITY;
    for (uint k = 0; k < EXTREMES; ++k) {
        const float8 a = fma(cosine, u[k], sine * v[k]), b = fma(cosine, v[k], -(sine * u[k]));
        low_a = LESSER(a, low_a);
        high_a = GREATER(a, high_a);
        low_b = LESSER(b, low_b);
        high_b = GREATER(b, high_b);
    }
    return cost_of(high_a - low_a, high_b - low_b, height);
}

/// Takes over the best of eight angles where its cost is below *least.
INLINE void take_best(float8 costs, float8 cosines, float8 sines, float* least, float* cosine, float* sine) {
    float cost[8], c[8], s[8];
    vstore8(costs, 0, cost);
    vstore8(cosines, 0, c);
    vstore8(sines, 0, s);
    for (uint k = 0; k < 8; ++k) {
        if (cost[k] < *least) {
            *least = cost[k];
            *cosine = c[k];
            *sine = s[k];
        }
    }
}

/// Turns p and q about the third axis: eight angles over the quarter turn after which a box is the same again, then
/// eight around the best. `steps` holds the cosines and sines of both.
INLINE void turn(const Vector* points, const Vector* axis, const float8* steps, Vector* p, Vector* q) {
    float u[EXTREMES], v[EXTREMES];
    float low = INFINITY, high = -INFINITY, low_u = INFINITY, high_u = -INFINITY, low_v = INFINITY, high_v = -INFINITY;
    for (uint k = 0; k < EXTREMES; ++k) {
        u[k] = dot3(p, &points[k]);
        v[k] = dot3(q, &points[k]);
        const float w = dot3(axis, &points[k]);
        widen(w, w, &low, &high);
        widen(u[k], u[k], &low_u, &high_u);
        widen(v[k], v[k], &low_v, &high_v);
    }
    const float height = high - low;
    float least = cost_of((float8)(high_u - low_u), (float8)(high_v - low_v), height).s0, cosine = 1.0f, sine = 0.0f;
    take_best(turned_cost(u, v, steps[0], steps[1], height), steps[0], steps[1], &least, &cosine, &sine);
    const float8 c = steps[2] * cosine - steps[3] * sine, s = steps[3] * cosine + steps[2] * sine;
    take_best(turned_cost(u, v, c, s, height), c, s, &least, &cosine, &sine);
    const Vector old = *p;
    scale3(cosine, p);
    add_scaled3(sine, q, p);
    scale3(cosine, q);
    add_scaled3(-sine, &old, q);
}

/// The measure of the box of the points along some axes.
INLINE float box_measure(const Vector* points, const Frame* axes) {
    Slabs slabs;
    empty_slabs(&slabs);
    for (uint k = 0; k < EXTREMES; ++k) add_point(axes, &points[k], &slabs);
    const Vector extent = {slabs.high.x - slabs.low.x, slabs.high.y - slabs.low.y, slabs.high.z - slabs.low.z};
    return measure_of(&extent);
}

INLINE void covariance_axes(const Vector* points, Frame* axes) {
    Vector mean = {0.0f, 0.0f, 0.0f};
    Symmetric covariance = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
    for (uint k = 0; k < EXTREMES; ++k) add_scaled3(1.0f / EXTREMES, &points[k], &mean);
    for (uint k = 0; k < EXTREMES; ++k) {
        Vector p = points[k];
        add_scaled3(-1.0f, &mean, &p);
        add_outer(1.0f / EXTREMES, &p, &covariance);
    }
    eigenvectors(&covariance, axes);
}

/// A frame of no larger measure than `axes`, from there.
static void refine(const Vector* points, const float8* steps, Frame* axes) {
    for (int round = 0; round < ROUNDS; ++round) {
        turn(points, &axes->c, steps, &axes->a, &axes->b);
        turn(points, &axes->a, steps, &axes->b, &axes->c);
        turn(points, &axes->b, steps, &axes->c, &axes->a);
    }
    orthonormalise(axes);
}

/// The axes of the node of slot i, and only these of its box. Before: all extremes, and the sorted points that
/// they name.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void refine_frames(global const uint* slot_nodes, global const Aabb* aabbs, global const float* points, uint stride,
                   global const uint* extremes, global Obb* boxes, uint slot_count) {
    const uint i = (uint)get_global_id(0);
    if (i >= slot_count) return;
    const Nodes nodes = {aabbs, points, stride, 0, 0};
    const float8 steps[4] = {COARSE_COSINES, COARSE_SINES, FINE_COSINES, FINE_SINES};
    const uint node = slot_nodes[i];
    Space space;
    space_of(aabbs, &node, &space);
    Vector extreme[EXTREMES];
    for (uint k = 0; k < EXTREMES; ++k)
        load_space_point(&nodes, &space, extremes[EXTREMES * (size_t)i + k], &extreme[k]);
    Frame axes, straight;
    covariance_axes(extreme, &axes);
    identity_frame(&straight);
    if (box_measure(extreme, &straight) < box_measure(extreme, &axes)) axes = straight;
    refine(extreme, steps, &axes);
    store_frame(&axes, boxes, &node, 1);
}
