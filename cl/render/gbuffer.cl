// SPDX-License-Identifier: MIT
// Hits turned into the planes of a G-buffer. Macros: render/scene_arrays.h, render/texture.h when TEXTURES is 1, and
//
// PLANES      which planes there are, one bit each: 1 position, 2 geometric normal, 4 shading normal, 8 albedo, 16 depth,
//             32 derivatives of texture coordinates, 64 material, 128 instance, 256 primitive. The others may be null.
// GROUP_SIZE  work-items per work-group.
//
// compile: PLANES=511 MATERIALS=1 NORMALS=1 TANGENTS=1 UV_SETS=2 COLORS=1 TEXTURES=1 FILTER=2
// compile: PLANES=511 MATERIALS=0 NORMALS=0 TANGENTS=0 UV_SETS=1 COLORS=0 TEXTURES=1 FILTER=1
// compile: PLANES=511 MATERIALS=0 NORMALS=1 TANGENTS=0 UV_SETS=0 COLORS=0 TEXTURES=0
// compile: PLANES=12 MATERIALS=1 NORMALS=0 TANGENTS=0 UV_SETS=1 COLORS=1 TEXTURES=1 FILTER=0
// compile: PLANES=1 MATERIALS=0 NORMALS=0 TANGENTS=0 UV_SETS=0 COLORS=0 TEXTURES=0
#include "render/pixel_beam.h"

#if !defined(PLANES) || !defined(GROUP_SIZE)
#error "define PLANES and GROUP_SIZE"
#endif

#define HAS_PLACES (PLANES & (4 | 8 | 32 | 64))
#define HAS_BEAMS (UV_SETS && (PLANES & (4 | 8 | 32)))

/// One pixel of all planes.
typedef struct Pixel {
    float3 position, geometric_normal, shading_normal, albedo;
    float4 uv_derivatives;
    uint material;
} Pixel;

#if UV_SETS
inline float4 uv_derivatives_of(const SceneArrays* scene, const Place* place) {
    const float2 uv0 = vertex_uv(scene, place->corner.x, 0);
    const float2 edge1 = vertex_uv(scene, place->corner.y, 0) - uv0;
    const float2 edge2 = vertex_uv(scene, place->corner.z, 0) - uv0;
    return (float4)(place->weight_x.x * edge1 + place->weight_x.y * edge2,
                    place->weight_y.x * edge1 + place->weight_y.y * edge2);
}
#endif

/// What the planes show of a hit.
inline void find_pixel(const SceneArrays* scene, global const CameraRecord* camera, Ray ray, Hit hit, float share,
                       Pixel* pixel) {
#if HAS_PLACES
    Place place;
    place_of(scene, hit, &place);
    pixel->material = place.material;
#endif
#if HAS_BEAMS
    Beam beam;
    pixel_beam(camera, vload3(0, ray.direction), hit.t, share, &beam);
    place_beam(scene, vload3(0, ray.direction), hit, beam, &place);
#endif
#if PLANES & 7
    const Surface surface = surface_at(scene->positions, scene->triangles, scene->meshes, scene->instances, ray, hit);
    pixel->position = surface.point;
    pixel->geometric_normal = surface.normal;
#endif
#if PLANES & 4
    pixel->shading_normal = shading_normal(scene, &place, hit, surface, normalize_any(vload3(0, ray.direction)));
#endif
#if PLANES & 8
    pixel->albedo = color_at(scene, &place).xyz;
#endif
#if UV_SETS && (PLANES & 32)
    pixel->uv_derivatives = uv_derivatives_of(scene, &place);
#endif
}

/// Element i of every plane is what rays[i] met at hits[i]. A work-item writes `length` consecutive ones of the `count`. No
/// barriers: work-items share nothing.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) void
g_buffer(SCENE_PARAMETERS, global const CameraRecord* camera, global const Ray* rays, global const Hit* hits, uint count,
         uint length, float share, global float* out_positions, global float* geometric_normals,
         global float* shading_normals, global float* albedos, global float* depths, global float* uv_derivatives,
         global uint* out_materials, global uint* out_instances, global uint* primitives) {
    const SceneArrays scene = SCENE_ARRAYS;
    const ulong begin = (ulong)get_global_id(0) * length;
    const ulong end = min(begin + length, (ulong)count);
    for (ulong i = begin; i < end; ++i) {
        const float3 zero = (float3)(0.0f);
        Pixel pixel = {zero, zero, zero, zero, (float4)(0.0f), BOXWOOD_NONE};
        if (hits[i].primitive != BOXWOOD_NONE) find_pixel(&scene, camera, rays[i], hits[i], share, &pixel);
#if PLANES & 1
        vstore3(pixel.position, i, out_positions);
#endif
#if PLANES & 2
        vstore3(pixel.geometric_normal, i, geometric_normals);
#endif
#if PLANES & 4
        vstore3(pixel.shading_normal, i, shading_normals);
#endif
#if PLANES & 8
        vstore3(pixel.albedo, i, albedos);
#endif
#if PLANES & 16
        depths[i] = hits[i].t;
#endif
#if PLANES & 32
        vstore4(pixel.uv_derivatives, i, uv_derivatives);
#endif
#if PLANES & 64
        out_materials[i] = pixel.material;
#endif
#if PLANES & 128
        out_instances[i] = hits[i].instance;
#endif
#if PLANES & 256
        primitives[i] = hits[i].primitive;
#endif
    }
}
