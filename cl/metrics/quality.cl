// SPDX-License-Identifier: MIT
// Surface area and volume of every node, for the metrics of a tree.
//
// Both are in units of `unit`, a power of two near the size of the scene, so that neither overflows nor vanishes.
// Unused slots (empty boxes) count as 0; otherwise they would spoil every sum.
// compile:
#include "runtime/products.h"
#include "shared/aabb.h"
#include "shared/obb.h"

typedef struct Measures {
    float area;
    float volume;
} Measures;

inline void measure_aabb(global const Aabb* box, float unit, Measures* result) {
    if (!(box->min[0] <= box->max[0])) {
        result->area = result->volume = 0.0f;
        return;
    }
    const float x = (box->max[0] - box->min[0]) / unit;
    const float y = (box->max[1] - box->min[1]) / unit;
    const float z = (box->max[2] - box->min[2]) / unit;
    result->area = 2.0f * (x * y + y * z + z * x);
    result->volume = x * y * z;
}

/// Scales a vector to unit length, without overflow or loss whatever its length was, which is returned.
inline float unit_axis(global const float* row, float3* axis) {
    const float3 v = (float3)(row[0], row[1], row[2]);
    const float largest = max(max(fabs(v.x), fabs(v.y)), fabs(v.z));
    const float length_over_largest = sqrt(dot_float3(v / largest, v / largest));
    *axis = v / largest / length_over_largest;
    return largest * length_over_largest;
}

/// A parallelepiped of the distances 2 d_k between faces with unit normals n_k has the volume 8 d0 d1 d2 / |det n| and
/// the faces 4 d_i d_j / |det n|. Returns false where rounding leaves no determinant.
inline bool measure_obb(global const Obb* box, float unit, Measures* result) {
    float3 normals[3];
    float d[3];
    for (int k = 0; k < 3; ++k) d[k] = box->extent[k] / unit_axis(box->axes + 3 * k, normals + k) / unit;
    const float det = fabs(dot_float3(normals[0], cross_float3(normals[1], normals[2])));
    if (!(det > 0.0f)) return false;
    result->area = 8.0f * (d[0] * d[1] + d[1] * d[2] + d[2] * d[0]) / det;
    result->volume = 8.0f * d[0] * d[1] * d[2] / det;
    return true;
}

/// areas[i], box_volumes[i] of node first + i.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void aabb_measures(global const Aabb* volumes, global float* areas, global float* box_volumes, float unit, uint first,
                   uint count) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    Measures measures;
    measure_aabb(volumes + first + i, unit, &measures);
    areas[i] = measures.area;
    box_volumes[i] = measures.volume;
}

/// The same with oriented boxes; a node that keeps its AABB is measured by it. fitted[i] = 1 for a node that does not,
/// else 0.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void obb_measures(global const Aabb* volumes, global const Obb* boxes, global float* areas, global float* box_volumes,
                  global uint* fitted, float unit, uint first, uint count) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    global const Obb* box = boxes + first + i;
    const bool oriented = box->aligned == 0 && box->extent[0] >= 0.0f;
    Measures measures;
    if (!oriented || !measure_obb(box, unit, &measures)) measure_aabb(volumes + first + i, unit, &measures);
    areas[i] = measures.area;
    box_volumes[i] = measures.volume;
    fitted[i] = oriented ? 1 : 0;
}

/// roots[t] = area of the root of tree t: of its first inner node, or of its only leaf.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void root_areas(global const float* inner, global const float* leaves, global const uint* offsets, global float* roots,
                uint trees) {
    const uint tree = (uint)get_global_id(0);
    if (tree >= trees) return;
    const uint begin = offsets[tree];
    roots[tree] = offsets[tree + 1] - begin > 1 ? inner[begin] : leaves[begin];
}
