// SPDX-License-Identifier: MIT
// The functions of projected_area.h and distribution.h, one call a work-item.
// compile: GROUP_SIZE=1
#include "influence/distribution.h"

/// probabilities[2 i + culled] of box i for areas[i].
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void probability_test(global const InfluenceRecord* areas, global const Aabb* boxes, global float* probabilities,
                      uint count) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const InfluenceRecord area = areas[i];
    const Box box = load_box(boxes + i);
    probabilities[2 * i] = area_probability(&area, box, false);
    probabilities[2 * i + 1] = area_probability(&area, box, true);
}

/// corners[8 i ..]: the table's outline of box i from an eye, ended by -1.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void table_test(global const float* eyes, global const Aabb* boxes, global int* corners, uint count) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const float3 eye = vload3(i, eyes);
    const Box box = load_box(boxes + i);
    const uint entry = hull_table[faces_from_eye(box.a.xyz - eye, (float3)(box.a.w, box.b) - eye)];
    for (uint k = 0; k < 8; ++k) corners[8 * i + k] = k < entry >> 18 ? (int)((entry >> (3 * k)) & 7u) : -1;
}

/// measures[3 i ..] = surface, projected and expected measure of box i for all areas, their root and the isotropic
/// share.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void measure_test(global const InfluenceRecord* areas, global const Aabb* root, global const Aabb* boxes,
                  global float* measures, float isotropic, uint area_count, uint count) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const Distribution distribution = {areas, area_count, isotropic, load_box(root)};
    const Box box = load_box(boxes + i);
    measures[3 * i] = surface_measure(&distribution, box);
    measures[3 * i + 1] = projected_measure(&distribution, box);
    measures[3 * i + 2] = expected_measure(&distribution, box);
}

/// directions[3 i ..] of areas[i] at points[3 i ..].
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void direction_test(global const InfluenceRecord* areas, global const float* points, global float* directions,
                    uint count) {
    const uint i = (uint)get_global_id(0);
    if (i >= count) return;
    const InfluenceRecord area = areas[i];
    vstore3(area_direction(&area, vload3(i, points)), i, directions);
}
