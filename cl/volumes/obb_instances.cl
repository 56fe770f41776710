// SPDX-License-Identifier: MIT
// Oriented boxes of the top level: the leaves are the boxes of meshes under the transforms of their instances, M_i =
// M_o M_m (dissertation 3.1.4 and 3.6.2). While the nodes above are fitted, a leaf is its 8 corners, and an orthonormal
// box around them; at the end it becomes the parallelepiped itself.
//
// MOMENTS  as in obb_leaves.cl
// POINTS_PER_PRIMITIVE  8
// LANES  1
// MEASURE_AREA, FALLBACK  see bounds/oriented_box.h
// compile: MOMENTS=1 POINTS_PER_PRIMITIVE=8 LANES=1 MEASURE_AREA=0 FALLBACK=1
// compile: MOMENTS=0 POINTS_PER_PRIMITIVE=8 LANES=1 MEASURE_AREA=1 FALLBACK=0
#include "bounds/placement.h"
#include "bounds/rotation.h"
#include "volumes/obb_node.h"
#include "shared/instance.h"

/// A placed box: its centre and half edges in world space, and how far any sum of them may be off.
typedef struct Placed {
    Vector center;
    Vector edges[3];
    Vector error;
} Placed;

INLINE void load_row(global const float* matrix, int row, Vector* v) {
    v->x = matrix[4 * row];
    v->y = matrix[4 * row + 1];
    v->z = matrix[4 * row + 2];
}

INLINE void load_vector(global const float* source, Vector* v) {
    v->x = source[0];
    v->y = source[1];
    v->z = source[2];
}

INLINE void load_vector_private(const float* source, Vector* v) {
    v->x = source[0];
    v->y = source[1];
    v->z = source[2];
}

/// A centre, an edge or a corner takes dot products of 3 and sums of 4 terms, and a corner is read relative to the
/// origin of a node's space: 16 roundoffs of the sum of all magnitudes. The box's edges are the columns of the inverse
/// of its axes, not exactly their rows: along each axis, those of all three edges together are off by 56 roundoffs (8
/// and twice 24, see orthonormalise) of the longest. 72 of all magnitudes with the longest extent on each axis bound
/// both. What a ray in object space may be off comes on top, so that the nodes above are around every hit.
INLINE void transform_box(global const InstanceRecord* record, global const Obb* box, const SceneSphere* sphere,
                          Placed* placed) {
    Vector center;
    load_vector(box->center, &center);
    float position[3], edge[3][3], size[3];
    const float longest = larger(box->extent[0], larger(box->extent[1], box->extent[2]));
    for (int row = 0; row < 3; ++row) {
        Vector m;
        load_row(record->to_world, row, &m);
        const float shift = record->to_world[4 * row + 3];
        position[row] = dot3(&m, &center) + shift;
        size[row] = reach3(&m, &center) + fabs(shift);
        for (int k = 0; k < 3; ++k) {
            Vector axis;
            load_vector(box->axes + 3 * k, &axis);
            size[row] += longest * reach3(&m, &axis);
            scale3(box->extent[k], &axis);
            edge[k][row] = dot3(&m, &axis);
        }
    }
    load_vector_private(position, &placed->center);
    for (int k = 0; k < 3; ++k) load_vector_private(edge[k], &placed->edges[k]);
    load_vector_private(size, &placed->error);
    scale3(72.0f * ROUNDOFF, &placed->error);
    float error[3];
    Vector moved;
    placement_error(record, sphere, error);
    load_vector_private(error, &moved);
    add_scaled3((real)(1.0f), &moved, &placed->error);
}

/// A frame along the edges as nearly as may be: the rotation in the matrix that has their directions for its columns.
/// A box is the same under inversion, so a mirrored one is turned inside out.
INLINE void placed_frame(global const InstanceRecord* record, global const Obb* box, Frame* axes) {
    Vector columns[3];
    for (int k = 0; k < 3; ++k) {
        Vector axis, row;
        float image[3];
        load_vector(box->axes + 3 * k, &axis);
        for (int i = 0; i < 3; ++i) {
            load_row(record->to_world, i, &row);
            image[i] = dot3(&row, &axis);
        }
        load_vector_private(image, &columns[k]);
    }
    const float size = larger(largest3(&columns[0]), larger(largest3(&columns[1]), largest3(&columns[2])));
    for (int k = 0; k < 3; ++k) scale3(inverse_power(power_below(size)), &columns[k]);
    Vector normal;
    cross3(&columns[0], &columns[1], &normal);
    if (dot3(&normal, &columns[2]) < 0.0f)
        for (int k = 0; k < 3; ++k) scale3(-1.0f, &columns[k]);
    const Frame matrix = {columns[0], columns[1], columns[2]};
    // Where nothing is sheared this start is the rotation; elsewhere any unit quaternion will do.
    Frame start = matrix;
    Quaternion q;
    orthonormalise(&start);
    quaternion_of(&start, &q);
    extract_rotation(&matrix, &q);
    frame_of(&q, axes);
    orthonormalise(axes);
}

/// The corners of the instance at sorted position i, their error, the box around them along its axes, and with MOMENTS
/// their moments.
/// Before: aabbs of all nodes.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void instance_leaves(global const uint* order, global const InstanceRecord* instances, global const Obb* mesh_boxes,
                     global const Aabb* aabbs, global float* points, uint stride, global float* errors,
                     global float* moments, global Obb* boxes, uint count, SceneSphere sphere) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    global const InstanceRecord* record = &instances[order[i]];
    global const Obb* box = &mesh_boxes[record->mesh];
    Placed placed;
    transform_box(record, box, &sphere, &placed);
    const uint leaf = count + i;
    errors[4 * (size_t)leaf] = placed.error.x;
    errors[4 * (size_t)leaf + 1] = placed.error.y;
    errors[4 * (size_t)leaf + 2] = placed.error.z;
    errors[4 * (size_t)leaf + 3] = 0.0f;
    Space space;
    Frame axes;
    Slabs slabs;
    Vector inside[8];
    space_of(aabbs, &leaf, &space);
    placed_frame(record, box, &axes);
    empty_slabs(&slabs);
    for (uint corner = 0; corner < 8; ++corner) {
        Vector p = placed.center;
        for (int k = 0; k < 3; ++k) add_scaled3((corner >> k & 1) != 0 ? 1.0f : -1.0f, &placed.edges[k], &p);
        points[8 * (size_t)i + corner] = p.x;
        points[stride + 8 * (size_t)i + corner] = p.y;
        points[2 * (size_t)stride + 8 * (size_t)i + corner] = p.z;
        to_space(&space, &p, &inside[corner]);
        add_point(&axes, &inside[corner], &slabs);
    }
#if MOMENTS
    Moments found;
    primitive_moments(inside, &found);
    store_moments(&found, moments, &leaf, 1);
#endif
    Vector inexact = placed.error;
    scale3(space.inverse_unit, &inexact);
    finish_boxes(&space, &axes, &slabs, &inexact, boxes, &leaf, 1);
}

/// errors of the nodes of one level: the largest below.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void merge_errors(global const uint* level, uint first, uint level_count, global const uint2* children,
                  global float* errors) {
    const uint i = (uint)get_global_id(0);
    if (i >= level_count) return;
    const uint node = level[first + i];
    const uint2 below = children[node];
    const float4 a = vload4(below.x, errors), b = vload4(below.y, errors);
    vstore4(GREATER(a, b), node, errors);
}

/// |row| . |v|
INLINE float row_reach(global const float* matrix, int row, const Vector* v) {
    Vector m;
    load_row(matrix, row, &m);
    return reach3(&m, v);
}

#if FALLBACK

/// The parallelepiped's volume or area, in the unit of `space`.
INLINE float placed_measure(const Placed* placed, const Space* space) {
    Vector e[3], normal[3];
    for (int k = 0; k < 3; ++k) {
        e[k] = placed->edges[k];
        scale3(space->inverse_unit, &e[k]);
    }
    for (int k = 0; k < 3; ++k) cross3(&e[(k + 1) % 3], &e[(k + 2) % 3], &normal[k]);
#if MEASURE_AREA
    return sqrt(dot3(&normal[0], &normal[0])) + sqrt(dot3(&normal[1], &normal[1])) + sqrt(dot3(&normal[2], &normal[2]));
#else
    return fabs(dot3(&normal[0], &e[0]));
#endif
}

#endif

/// The box of the leaf at sorted position i as it is: the mesh's box in the mesh's space, by way of to_object. Its rows
/// are those of the mesh's axes times to_object, scaled by a power of two.
///
/// Widened by 9 roundoffs of what the terms amount to: to_object is the inverse rounded once (1), the rows (4) and the
/// centre (4) take dot products; and by what a ray that is moved to object space may be off there. `around` bounds
/// |to_world| times the box about its centre, `magnitude` the terms of the centre besides.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void transform_leaves(global const uint* order, global const InstanceRecord* instances, global const Obb* mesh_boxes,
                      global const Aabb* aabbs, global Obb* boxes, uint count, SceneSphere sphere) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    global const InstanceRecord* record = &instances[order[i]];
    global const Obb* box = &mesh_boxes[record->mesh];
    const uint leaf = count + i;
    Placed placed;
    transform_box(record, box, &sphere, &placed);
#if FALLBACK
    Space space;
    space_of(aabbs, &leaf, &space);
    const Vector straight = {0.5f * (space.high.x - space.low.x), 0.5f * (space.high.y - space.low.y),
                             0.5f * (space.high.z - space.low.z)};
    if (!(placed_measure(&placed, &space) < measure_of(&straight))) {
        boxes[leaf].aligned = 1;
        for (int k = 0; k < 9; ++k) boxes[leaf].axes[k] = k % 4 == 0 ? 1.0f : 0.0f;
        const float center[3] = {space.origin.x, space.origin.y, space.origin.z};
        const float reach[3] = {space.reach.x, space.reach.y, space.reach.z};
        for (int k = 0; k < 3; ++k) {
            boxes[leaf].center[k] = center[k];
            boxes[leaf].extent[k] = fma(reach[k] * (1.0f + 4.0f * ROUNDOFF), space.unit, 0x1p-149f);
        }
        return;
    }
#endif
    Vector center, around = {0.0f, 0.0f, 0.0f};
    load_vector(box->center, &center);
    for (int k = 0; k < 3; ++k) {
        Vector axis;
        load_vector(box->axes + 3 * k, &axis);
        around.x = fma(fabs(axis.x), box->extent[k], around.x);
        around.y = fma(fabs(axis.y), box->extent[k], around.y);
        around.z = fma(fabs(axis.z), box->extent[k], around.z);
    }
    float sum[3];
    for (int row = 0; row < 3; ++row)
        sum[row] = row_reach(record->to_world, row, &around) + row_reach(record->to_world, row, &center) +
                   fabs(record->to_world[4 * row + 3]);
    const Vector magnitude = {sum[0], sum[1], sum[2]};
    float moved[3];
    object_error(record, &sphere, moved);
    Obb result;
    result.aligned = 0;
    result.center[0] = placed.center.x;
    result.center[1] = placed.center.y;
    result.center[2] = placed.center.z;
    for (int k = 0; k < 3; ++k) {
        float row[3] = {0.0f, 0.0f, 0.0f}, error = 0.0f;
        for (int j = 0; j < 3; ++j) {
            const float weight = box->axes[3 * k + j];
            for (int column = 0; column < 3; ++column)
                row[column] = fma(weight, record->to_object[4 * j + column], row[column]);
            const float terms = row_reach(record->to_object, j, &magnitude) + fabs(record->to_object[4 * j + 3]);
            error = fma(fabs(weight), fma(9.0f * ROUNDOFF, terms, moved[j]), error);
        }
        const float largest = larger(fabs(row[0]), larger(fabs(row[1]), fabs(row[2])));
        const float scale = inverse_power(power_below(largest));
        for (int column = 0; column < 3; ++column) result.axes[3 * k + column] = row[column] * scale;
        result.extent[k] = fma(1.0f + 4.0f * ROUNDOFF, box->extent[k], error) * scale;
    }
    boxes[leaf] = result;
}
