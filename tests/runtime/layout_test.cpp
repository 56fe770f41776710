// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cstddef>

#include "runtime/launch.hpp"
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
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("runtime");

// clang-format off
TEST_CASE("layout: host and device agree on size and offsets of every shared struct") {
    // Same order as tests/runtime/layout_test.cl.
    const std::vector<std::size_t> expected{
        sizeof(Aabb), offsetof(Aabb, min), offsetof(Aabb, max),
        sizeof(CameraRecord), offsetof(CameraRecord, origin), offsetof(CameraRecord, perspective),
        offsetof(CameraRecord, forward), offsetof(CameraRecord, width), offsetof(CameraRecord, right),
        offsetof(CameraRecord, height), offsetof(CameraRecord, up), offsetof(CameraRecord, reserved),
        sizeof(InstanceRecord), offsetof(InstanceRecord, to_object), offsetof(InstanceRecord, to_world),
        offsetof(InstanceRecord, mesh), offsetof(InstanceRecord, root), offsetof(InstanceRecord, reserved),
        sizeof(MeshRange), offsetof(MeshRange, first_vertex), offsetof(MeshRange, vertex_count),
        offsetof(MeshRange, first_triangle), offsetof(MeshRange, triangle_count),
        sizeof(BinaryNode), offsetof(BinaryNode, bounds), offsetof(BinaryNode, child), offsetof(BinaryNode, reserved),
        sizeof(Wide8Node), offsetof(Wide8Node, min_x), offsetof(Wide8Node, max_x), offsetof(Wide8Node, min_y),
        offsetof(Wide8Node, max_y), offsetof(Wide8Node, min_z), offsetof(Wide8Node, max_z), offsetof(Wide8Node, child),
        offsetof(Wide8Node, count), offsetof(Wide8Node, reserved),
        sizeof(Ray), offsetof(Ray, origin), offsetof(Ray, t_min), offsetof(Ray, direction), offsetof(Ray, t_max),
        sizeof(Hit), offsetof(Hit, t), offsetof(Hit, u), offsetof(Hit, v), offsetof(Hit, primitive),
        offsetof(Hit, instance), sizeof(RayStatistics), offsetof(RayStatistics, volumes),
        offsetof(RayStatistics, primitives), offsetof(RayStatistics, areas),
        sizeof(Triangle), offsetof(Triangle, v0), offsetof(Triangle, primitive), offsetof(Triangle, v1),
        offsetof(Triangle, reserved1), offsetof(Triangle, v2), offsetof(Triangle, reserved2),
        sizeof(Triangle4), offsetof(Triangle4, v0_x), offsetof(Triangle4, v0_y), offsetof(Triangle4, v0_z),
        offsetof(Triangle4, v1_x), offsetof(Triangle4, v1_y), offsetof(Triangle4, v1_z),
        offsetof(Triangle4, v2_x), offsetof(Triangle4, v2_y), offsetof(Triangle4, v2_z),
        offsetof(Triangle4, primitive),
        sizeof(SceneSphere), offsetof(SceneSphere, center), offsetof(SceneSphere, radius),
        sizeof(ScreenTriangle), offsetof(ScreenTriangle, surface), offsetof(ScreenTriangle, corners),
        offsetof(ScreenTriangle, instance), offsetof(ScreenTriangle, nearest), offsetof(ScreenTriangle, left),
        offsetof(ScreenTriangle, right), offsetof(ScreenTriangle, top), offsetof(ScreenTriangle, bottom),
        sizeof(TextureInput), offsetof(TextureInput, texture), offsetof(TextureInput, uv_set),
        offsetof(TextureInput, rows), sizeof(MaterialRecord), offsetof(MaterialRecord, base_color),
        offsetof(MaterialRecord, emission), offsetof(MaterialRecord, metallic), offsetof(MaterialRecord, roughness),
        offsetof(MaterialRecord, normal_scale), offsetof(MaterialRecord, occlusion_strength),
        offsetof(MaterialRecord, alpha_cutoff), offsetof(MaterialRecord, specular), offsetof(MaterialRecord, flags),
        offsetof(MaterialRecord, textures), sizeof(TextureRecord), offsetof(TextureRecord, first_texel),
        offsetof(TextureRecord, width), offsetof(TextureRecord, height), offsetof(TextureRecord, levels),
        offsetof(TextureRecord, wrap_u), offsetof(TextureRecord, wrap_v), offsetof(TextureRecord, nearest),
        offsetof(TextureRecord, format), sizeof(LightRecord), offsetof(LightRecord, position),
        offsetof(LightRecord, kind), offsetof(LightRecord, direction), offsetof(LightRecord, range),
        offsetof(LightRecord, intensity), offsetof(LightRecord, inverse_size), offsetof(LightRecord, edges),
        offsetof(LightRecord, cone_scale), offsetof(LightRecord, cone_edge), offsetof(LightRecord, instance),
        offsetof(LightRecord, primitive), offsetof(LightRecord, two_sided),
        sizeof(InfluenceRecord), offsetof(InfluenceRecord, origin), offsetof(InfluenceRecord, point),
        offsetof(InfluenceRecord, right), offsetof(InfluenceRecord, half_width), offsetof(InfluenceRecord, up),
        offsetof(InfluenceRecord, half_height), offsetof(InfluenceRecord, forward), offsetof(InfluenceRecord, near),
        offsetof(InfluenceRecord, far), offsetof(InfluenceRecord, sin_tolerance), offsetof(InfluenceRecord, share),
        offsetof(InfluenceRecord, reserved), sizeof(LocalArea), offsetof(LocalArea, region), offsetof(LocalArea, box),
        offsetof(LocalArea, root), offsetof(LocalArea, near), sizeof(AreaNode), offsetof(AreaNode, split),
        offsetof(AreaNode, axis), offsetof(AreaNode, first), offsetof(AreaNode, count), sizeof(RayVisits),
        offsetof(RayVisits, nodes), offsetof(RayVisits, primitives), offsetof(RayVisits, nodes_to_hit),
        offsetof(RayVisits, primitives_to_hit), sizeof(Thresholds), offsetof(Thresholds, max_leaf_cost),
        offsetof(Thresholds, max_leaf_area), offsetof(Thresholds, max_leaf_hit_probability),
        offsetof(Thresholds, max_leaf_primitives), offsetof(Thresholds, max_levels),
        offsetof(Thresholds, max_non_fallback_levels), offsetof(Thresholds, split_plane_quality),
        offsetof(Thresholds, acceptable_children), offsetof(Thresholds, excellent_children),
        offsetof(Thresholds, reserved)};
    // clang-format on
    Guarded<std::uint32_t> out(test_device(), 1 + expected.size());
    launch(test_device(), {"runtime/layout_test.cl", "layout_test"}, "layout test", 1, out.view());
    const std::vector<std::uint32_t> got = out.values();
    REQUIRE(out.intact());
    REQUIRE(got[0] == expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        CAPTURE(i);
        CHECK(got[1 + i] == expected[i]);
    }
}
