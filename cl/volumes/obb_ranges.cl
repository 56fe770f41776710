// SPDX-License-Identifier: MIT
// Oriented boxes, third part: passes over all points below each node, which are one range of the sorted points
// (dissertation 3.1.3 and the first algorithm of 3.5).
//
//   node_chunks    how many chunks of CHUNK primitives the range of each long node has; 0 for the others
//   short_nodes    nodes with up to CHUNK primitives, each by one work-item
//   long_chunks    the chunks of the long nodes, whichever node they belong to, each by one work-item
//   long_nodes     joins the chunks of each long node
//
// No work-item reads more than a slice of short ranges or one chunk at a time, whatever the shape of the tree. Sums are
// made in an order that depends on the range alone.
//
// PASS   0: the covariance of the points; its eigenvectors become the node's axes. 1: the box of the points along the
//        axes.
// CHUNK  primitives, see above
// JACOBI_SWEEPS  see bounds/eigen.h
// POINTS_PER_PRIMITIVE, LANES, MEASURE_AREA, FALLBACK  see volumes/obb_node.h, runtime/real.h, bounds/oriented_box.h
// compile: PASS=0 CHUNK=4096 JACOBI_SWEEPS=3 POINTS_PER_PRIMITIVE=3 LANES=8 MEASURE_AREA=0 FALLBACK=1
// compile: PASS=0 CHUNK=255 JACOBI_SWEEPS=2 POINTS_PER_PRIMITIVE=3 LANES=8 MEASURE_AREA=0 FALLBACK=1
// compile: PASS=1 CHUNK=4096 POINTS_PER_PRIMITIVE=3 LANES=8 MEASURE_AREA=1 FALLBACK=1
// compile: PASS=0 CHUNK=4096 JACOBI_SWEEPS=3 POINTS_PER_PRIMITIVE=8 LANES=1 MEASURE_AREA=0 FALLBACK=1
// compile: PASS=1 CHUNK=4096 POINTS_PER_PRIMITIVE=8 LANES=1 MEASURE_AREA=0 FALLBACK=0
#include "bounds/eigen.h"
#include "volumes/obb_node.h"
#include "primitives/segments.h"

#if PASS == 0
#define RESULTS 9 // mean, covariance
#else
#define RESULTS 6 // ends of the slabs: low, high
#endif

/// What a pass over points needs of a node.
typedef struct Range {
    float origin[3]; ///< Times -inverse_unit.
    float inverse_unit;
    float axes[9];
} Range;

INLINE void load_points(const Nodes* nodes, const Range* range, uint place, float8* x, float8* y, float8* z) {
    global const float* xs = nodes->points;
    const float8 scale = range->inverse_unit;
    // One rounding, that of the difference: both products are exact.
    *x = fma(vload8(0, xs + place), scale, (float8)(range->origin[0]));
    *y = fma(vload8(0, xs + nodes->stride + place), scale, (float8)(range->origin[1]));
    *z = fma(vload8(0, xs + 2 * (size_t)nodes->stride + place), scale, (float8)(range->origin[2]));
}

#if PASS == 0

INLINE float sum_lanes(float8 v) {
    const float4 quarter = v.lo + v.hi;
    return (quarter.x + quarter.z) + (quarter.y + quarter.w);
}

/// Mean and covariance of the points [begin, end), 8 at a time. The points behind the last 8 count with weight 0.
INLINE void pass_over(const Nodes* nodes, const Range* range, uint begin, uint end, float* result) {
    const int8 lane = (int8)(0, 1, 2, 3, 4, 5, 6, 7);
    float8 sx = 0.0f, sy = 0.0f, sz = 0.0f;
    float8 xx = 0.0f, yy = 0.0f, zz = 0.0f, xy = 0.0f, xz = 0.0f, yz = 0.0f;
    for (uint place = begin; place < end; place += 8) {
        float8 x, y, z;
        load_points(nodes, range, place, &x, &y, &z);
        if (end - place < 8) {
            const int8 behind = lane >= (int8)((int)(end - place));
            x = select(x, (float8)(0.0f), behind);
            y = select(y, (float8)(0.0f), behind);
            z = select(z, (float8)(0.0f), behind);
        }
        sx += x;
        sy += y;
        sz += z;
        xx = fma(x, x, xx);
        yy = fma(y, y, yy);
        zz = fma(z, z, zz);
        xy = fma(x, y, xy);
        xz = fma(x, z, xz);
        yz = fma(y, z, yz);
    }
    // The origin of the space is the middle of the node, so the mean is not far from it beside the spread.
    const float share = 1.0f / (float)(end - begin);
    const float x = share * sum_lanes(sx), y = share * sum_lanes(sy), z = share * sum_lanes(sz);
    result[0] = x;
    result[1] = y;
    result[2] = z;
    result[3] = fma(-x, x, share * sum_lanes(xx));
    result[4] = fma(-y, y, share * sum_lanes(yy));
    result[5] = fma(-z, z, share * sum_lanes(zz));
    result[6] = fma(-x, y, share * sum_lanes(xy));
    result[7] = fma(-x, z, share * sum_lanes(xz));
    result[8] = fma(-y, z, share * sum_lanes(yz));
}

/// Joins the results of chunks of `size` and `total` points.
INLINE void join(const float* part, float size, float total, float* result) {
    const float share = size / (size + total), rest = 1.0f - share;
    const float x = part[0] - result[0], y = part[1] - result[1], z = part[2] - result[2];
    const float both = share * rest;
    for (int k = 0; k < 9; ++k)
        result[k] = k < 3 ? fma(share, part[k] - result[k], result[k]) : fma(share, part[k], rest * result[k]);
    result[3] = fma(both * x, x, result[3]);
    result[4] = fma(both * y, y, result[4]);
    result[5] = fma(both * z, z, result[5]);
    result[6] = fma(both * x, y, result[6]);
    result[7] = fma(both * x, z, result[7]);
    result[8] = fma(both * y, z, result[8]);
}

#else

INLINE float least_lane(float8 v) {
    const float4 half_way = LESSER(v.lo, v.hi);
    const float2 pair = LESSER(half_way.lo, half_way.hi);
    return LESSER(pair.x, pair.y);
}

INLINE void widen8(float8 a, float8* low, float8* high) {
    *low = LESSER(a, *low);
    *high = GREATER(a, *high);
}

/// Ends of the slabs of the points [begin, end) along the three axes, 8 points at a time; the last 8 may overlap the
/// ones before, and of a set of fewer than 8 the first counts again.
INLINE void pass_over(const Nodes* nodes, const Range* range, uint begin, uint end, float* result) {
    const float8 ax = range->axes[0], ay = range->axes[1], az = range->axes[2];
    const float8 bx = range->axes[3], by = range->axes[4], bz = range->axes[5];
    const float8 cx = range->axes[6], cy = range->axes[7], cz = range->axes[8];
    const float8 infinity = INFINITY;
    float8 low_a = infinity, low_b = infinity, low_c = infinity;
    float8 high_a = -infinity, high_b = -infinity, high_c = -infinity;
    const uint size = end - begin;
    for (uint done = 0; done < size; done += 8) {
        float8 x, y, z;
        const uint place = size - done >= 8 ? begin + done : size >= 8 ? end - 8 : begin;
        load_points(nodes, range, place, &x, &y, &z);
        if (size < 8) {
            const int8 behind = (int8)(0, 1, 2, 3, 4, 5, 6, 7) >= (int8)((int)size);
            x = select(x, (float8)(x.s0), behind);
            y = select(y, (float8)(y.s0), behind);
            z = select(z, (float8)(z.s0), behind);
        }
        widen8(fma(ax, x, fma(ay, y, az * z)), &low_a, &high_a);
        widen8(fma(bx, x, fma(by, y, bz * z)), &low_b, &high_b);
        widen8(fma(cx, x, fma(cy, y, cz * z)), &low_c, &high_c);
    }
    result[0] = least_lane(low_a);
    result[1] = least_lane(low_b);
    result[2] = least_lane(low_c);
    result[3] = -least_lane(-high_a);
    result[4] = -least_lane(-high_b);
    result[5] = -least_lane(-high_c);
}

INLINE void join(const float* part, float size, float total, float* result) {
    (void)size;
    (void)total;
    for (int k = 0; k < 3; ++k) {
        result[k] = LESSER(part[k], result[k]);
        result[3 + k] = GREATER(part[3 + k], result[3 + k]);
    }
}

#endif

/// The spaces of nodes, in lanes and one by one.
INLINE void make_ranges(const Nodes* nodes, const uint* index, global const Obb* boxes, Space* space, Range* ranges) {
    float origin[3][LANES], inverse_unit[LANES];
    space_of(nodes->aabbs, index, space);
    STORE_LANES(-space->origin.x * space->inverse_unit, origin[0]);
    STORE_LANES(-space->origin.y * space->inverse_unit, origin[1]);
    STORE_LANES(-space->origin.z * space->inverse_unit, origin[2]);
    STORE_LANES(space->inverse_unit, inverse_unit);
    for (uint lane = 0; lane < LANES; ++lane) {
        for (int k = 0; k < 3; ++k) ranges[lane].origin[k] = origin[k][lane];
        ranges[lane].inverse_unit = inverse_unit[lane];
#if PASS == 1
        for (int k = 0; k < 9; ++k) ranges[lane].axes[k] = boxes[index[lane]].axes[k];
#endif
    }
}

/// Makes the axes (PASS 0) or the boxes (PASS 1) of nodes from what was found over their points.
INLINE void finish_nodes(const Nodes* nodes, const Space* space, float results[RESULTS][LANES], const uint* index,
                         uint used, global Obb* boxes) {
#if PASS == 0
    (void)nodes;
    (void)space;
    const Symmetric covariance = {LOAD_LANES(results[3]), LOAD_LANES(results[4]), LOAD_LANES(results[5]),
                                  LOAD_LANES(results[6]), LOAD_LANES(results[7]), LOAD_LANES(results[8])};
    Frame axes;
    eigenvectors(&covariance, &axes);
    store_frame(&axes, boxes, index, used);
#else
    const Slabs slabs = {{LOAD_LANES(results[0]), LOAD_LANES(results[1]), LOAD_LANES(results[2])},
                         {LOAD_LANES(results[3]), LOAD_LANES(results[4]), LOAD_LANES(results[5])}};
    Frame axes;
    Vector inexact;
    load_frame(boxes, index, &axes);
    inexact_of(nodes, index, space, &inexact);
    finish_boxes(space, &axes, &slabs, &inexact, boxes, index, used);
#endif
}

/// The next up to LANES nodes from *i on that have `wanted` or more chunks (1: the long ones; 0: the short ones, which
/// have none), *i behind the last; the lanes left over repeat one.
INLINE uint next_nodes(global const uint* chunks, global const uint2* children, uint wanted, uint end, uint* i,
                       uint* index) {
    uint used = 0;
    for (; *i < end && used < LANES; ++*i)
        if (children[*i].x != BOXWOOD_NONE && (chunks[*i] != 0) == (wanted != 0)) index[used++] = *i;
    for (uint lane = used; used != 0 && lane < LANES; ++lane) index[lane] = index[0];
    return used;
}

/// chunks[i] of every inner node; see above.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void node_chunks(global const uint2* children, global const uint* far_ends, global uint* chunks, uint count,
                 uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    if (begin >= count) return;
    const uint end = min(begin + slice, count);
    for (uint i = begin; i < end; ++i) {
        const uint size = children[i].x == BOXWOOD_NONE ? 0 : range_size(i, far_ends);
        chunks[i] = size > CHUNK ? (size - 1) / CHUNK + 1 : 0;
    }
}

/// The short nodes among those of one slice of node indices.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void short_nodes(global const uint* chunks, global const uint2* children, global const uint* far_ends,
                 global const Aabb* aabbs, global const float* points, uint stride, global const float* errors,
                 global Obb* boxes, uint count, uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    if (begin >= count) return;
    const uint end = min(begin + slice, count);
    const Nodes nodes = {aabbs, points, stride, errors, count};
    uint i = begin;
    while (true) {
        uint index[LANES];
        const uint used = next_nodes(chunks, children, 0, end, &i, index);
        if (used == 0) break;
        Space space;
        Range ranges[LANES];
        float results[RESULTS][LANES];
        make_ranges(&nodes, index, boxes, &space, ranges);
        for (uint lane = 0; lane < LANES; ++lane) {
            const uint2 ends = range_of(index[lane], far_ends, count) * POINTS_PER_PRIMITIVE;
            float result[RESULTS];
            pass_over(&nodes, &ranges[lane], ends.x, ends.y + POINTS_PER_PRIMITIVE, result);
            for (int k = 0; k < RESULTS; ++k) results[k][lane] = result[k];
        }
        finish_nodes(&nodes, &space, results, index, used, boxes);
    }
}

/// parts: RESULTS floats for each chunk; first_chunks is the exclusive scan of `chunks`.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void long_chunks(global const uint* first_chunks, global const uint* far_ends, global const Aabb* aabbs,
                 global const float* points, uint stride, global const Obb* boxes, global float* parts, uint count,
                 uint chunk_count) {
    const uint chunk = (uint)get_global_id(0);
    if (chunk >= chunk_count) return;
    const Nodes nodes = {aabbs, points, stride, 0, count};
    uint index[LANES];
    for (uint lane = 0; lane < LANES; ++lane) index[lane] = segment_of(first_chunks, count, chunk);
    const uint2 ends = range_of(index[0], far_ends, count);
    const uint first = ends.x + (chunk - first_chunks[index[0]]) * CHUNK;
    const uint last = min(first + CHUNK, ends.y + 1);
    Space space;
    Range ranges[LANES];
    float result[RESULTS];
    make_ranges(&nodes, index, boxes, &space, ranges);
    pass_over(&nodes, &ranges[0], first * POINTS_PER_PRIMITIVE, last * POINTS_PER_PRIMITIVE, result);
    for (int k = 0; k < RESULTS; ++k) parts[RESULTS * (size_t)chunk + k] = result[k];
}

/// The long nodes among those of one slice of node indices.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void long_nodes(global const uint* chunks, global const uint* first_chunks, global const uint2* children,
                global const uint* far_ends, global const Aabb* aabbs, global const float* errors,
                global const float* parts, global Obb* boxes, uint count, uint slice) {
    const uint begin = (uint)get_global_id(0) * slice;
    if (begin >= count) return;
    const uint end = min(begin + slice, count);
    const Nodes nodes = {aabbs, 0, 0, errors, count};
    uint i = begin;
    while (true) {
        uint index[LANES];
        const uint used = next_nodes(chunks, children, 1, end, &i, index);
        if (used == 0) break;
        float results[RESULTS][LANES];
        for (uint lane = 0; lane < LANES; ++lane) {
            const uint node = index[lane], size = range_size(node, far_ends);
            float result[RESULTS], part[RESULTS];
            for (uint c = 0; c < chunks[node]; ++c) {
                for (int k = 0; k < RESULTS; ++k) part[k] = parts[RESULTS * (size_t)(first_chunks[node] + c) + k];
                if (c == 0)
                    for (int k = 0; k < RESULTS; ++k) result[k] = part[k];
                else
                    join(part, (float)min((uint)CHUNK, size - c * CHUNK), (float)(c * CHUNK), result);
            }
            for (int k = 0; k < RESULTS; ++k) results[k][lane] = result[k];
        }
        Space space;
        space_of(aabbs, index, &space);
        finish_nodes(&nodes, &space, results, index, used, boxes);
    }
}
