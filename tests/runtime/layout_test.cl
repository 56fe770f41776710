// SPDX-License-Identifier: MIT
// Sizes and offsets of every shared struct as the device sees them.
//
// compile:
#include "shared/aabb.h"
#include "shared/area.h"
#include "shared/camera.h"
#include "shared/instance.h"
#include "shared/light.h"
#include "shared/material.h"
#include "shared/node.h"
#include "shared/raster.h"
#include "shared/ray.h"
#include "shared/scene_sphere.h"
#include "shared/topdown.h"
#include "shared/triangle.h"
#include "shared/visits.h"

#define OFFSET(type, member) (uint)((size_t)&((private type*)0)->member)

/// Same order as tests/runtime/layout_test.cpp.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) void layout_test(global uint* out) {
    if (get_global_id(0) != 0) return;
    const uint values[] = {
        sizeof(Aabb), OFFSET(Aabb, min), OFFSET(Aabb, max),
        sizeof(CameraRecord), OFFSET(CameraRecord, origin), OFFSET(CameraRecord, perspective),
        OFFSET(CameraRecord, forward), OFFSET(CameraRecord, width), OFFSET(CameraRecord, right),
        OFFSET(CameraRecord, height), OFFSET(CameraRecord, up), OFFSET(CameraRecord, reserved),
        sizeof(InstanceRecord), OFFSET(InstanceRecord, to_object), OFFSET(InstanceRecord, to_world),
        OFFSET(InstanceRecord, mesh), OFFSET(InstanceRecord, root), OFFSET(InstanceRecord, reserved),
        sizeof(MeshRange), OFFSET(MeshRange, first_vertex), OFFSET(MeshRange, vertex_count),
        OFFSET(MeshRange, first_triangle), OFFSET(MeshRange, triangle_count),
        sizeof(BinaryNode), OFFSET(BinaryNode, bounds), OFFSET(BinaryNode, child), OFFSET(BinaryNode, reserved),
        sizeof(Wide8Node), OFFSET(Wide8Node, min_x), OFFSET(Wide8Node, max_x), OFFSET(Wide8Node, min_y),
        OFFSET(Wide8Node, max_y), OFFSET(Wide8Node, min_z), OFFSET(Wide8Node, max_z), OFFSET(Wide8Node, child),
        OFFSET(Wide8Node, count), OFFSET(Wide8Node, reserved),
        sizeof(Ray), OFFSET(Ray, origin), OFFSET(Ray, t_min), OFFSET(Ray, direction), OFFSET(Ray, t_max),
        sizeof(Hit), OFFSET(Hit, t), OFFSET(Hit, u), OFFSET(Hit, v), OFFSET(Hit, primitive), OFFSET(Hit, instance),
        sizeof(RayStatistics), OFFSET(RayStatistics, volumes), OFFSET(RayStatistics, primitives), OFFSET(RayStatistics, areas),
        sizeof(Triangle), OFFSET(Triangle, v0), OFFSET(Triangle, primitive), OFFSET(Triangle, v1),
        OFFSET(Triangle, reserved1), OFFSET(Triangle, v2), OFFSET(Triangle, reserved2),
        sizeof(Triangle4), OFFSET(Triangle4, v0_x), OFFSET(Triangle4, v0_y), OFFSET(Triangle4, v0_z),
        OFFSET(Triangle4, v1_x), OFFSET(Triangle4, v1_y), OFFSET(Triangle4, v1_z),
        OFFSET(Triangle4, v2_x), OFFSET(Triangle4, v2_y), OFFSET(Triangle4, v2_z),
        OFFSET(Triangle4, primitive),
        sizeof(SceneSphere), OFFSET(SceneSphere, center), OFFSET(SceneSphere, radius),
        sizeof(ScreenTriangle), OFFSET(ScreenTriangle, surface), OFFSET(ScreenTriangle, corners),
        OFFSET(ScreenTriangle, instance), OFFSET(ScreenTriangle, nearest), OFFSET(ScreenTriangle, left),
        OFFSET(ScreenTriangle, right), OFFSET(ScreenTriangle, top), OFFSET(ScreenTriangle, bottom),
        sizeof(TextureInput), OFFSET(TextureInput, texture), OFFSET(TextureInput, uv_set), OFFSET(TextureInput, rows),
        sizeof(MaterialRecord), OFFSET(MaterialRecord, base_color), OFFSET(MaterialRecord, emission),
        OFFSET(MaterialRecord, metallic), OFFSET(MaterialRecord, roughness), OFFSET(MaterialRecord, normal_scale),
        OFFSET(MaterialRecord, occlusion_strength), OFFSET(MaterialRecord, alpha_cutoff),
        OFFSET(MaterialRecord, specular), OFFSET(MaterialRecord, flags), OFFSET(MaterialRecord, textures),
        sizeof(TextureRecord), OFFSET(TextureRecord, first_texel), OFFSET(TextureRecord, width),
        OFFSET(TextureRecord, height), OFFSET(TextureRecord, levels), OFFSET(TextureRecord, wrap_u),
        OFFSET(TextureRecord, wrap_v), OFFSET(TextureRecord, nearest), OFFSET(TextureRecord, format),
        sizeof(LightRecord), OFFSET(LightRecord, position), OFFSET(LightRecord, kind), OFFSET(LightRecord, direction),
        OFFSET(LightRecord, range), OFFSET(LightRecord, intensity), OFFSET(LightRecord, inverse_size),
        OFFSET(LightRecord, edges), OFFSET(LightRecord, cone_scale), OFFSET(LightRecord, cone_edge),
        OFFSET(LightRecord, instance), OFFSET(LightRecord, primitive), OFFSET(LightRecord, two_sided),
        sizeof(InfluenceRecord), OFFSET(InfluenceRecord, origin), OFFSET(InfluenceRecord, point),
        OFFSET(InfluenceRecord, right), OFFSET(InfluenceRecord, half_width), OFFSET(InfluenceRecord, up),
        OFFSET(InfluenceRecord, half_height), OFFSET(InfluenceRecord, forward), OFFSET(InfluenceRecord, near),
        OFFSET(InfluenceRecord, far), OFFSET(InfluenceRecord, sin_tolerance), OFFSET(InfluenceRecord, share),
        OFFSET(InfluenceRecord, reserved), sizeof(LocalArea), OFFSET(LocalArea, region), OFFSET(LocalArea, box),
        OFFSET(LocalArea, root), OFFSET(LocalArea, near), sizeof(AreaNode), OFFSET(AreaNode, split),
        OFFSET(AreaNode, axis), OFFSET(AreaNode, first), OFFSET(AreaNode, count), sizeof(RayVisits),
        OFFSET(RayVisits, nodes), OFFSET(RayVisits, primitives), OFFSET(RayVisits, nodes_to_hit),
        OFFSET(RayVisits, primitives_to_hit), sizeof(Thresholds), OFFSET(Thresholds, max_leaf_cost),
        OFFSET(Thresholds, max_leaf_area), OFFSET(Thresholds, max_leaf_hit_probability),
        OFFSET(Thresholds, max_leaf_primitives), OFFSET(Thresholds, max_levels),
        OFFSET(Thresholds, max_non_fallback_levels), OFFSET(Thresholds, split_plane_quality),
        OFFSET(Thresholds, acceptable_children), OFFSET(Thresholds, excellent_children), OFFSET(Thresholds, reserved)};
    const uint count = sizeof(values) / sizeof(uint);
    out[0] = count;
    for (uint i = 0; i < count; ++i) out[1 + i] = values[i];
}
