// SPDX-License-Identifier: MIT
// Turns hits into the planes of a G-buffer. Macros: render/scene_arrays.h, render/texture.h when TEXTURES is 1, and
//
// PLANES      which planes there are, one bit each: 1 position, 2 geometric normal, 4 shading normal, 8 albedo, 16
//             depth, 32 derivatives of texture coordinates, 64 material, 128 instance, 256 primitive. The others may be
//             null.
// GROUP_SIZE  work-items per work-group.
//
// compile: PLANES=511 MATERIALS=1 NORMALS=1 TANGENTS=1 UV_SETS=2 COLORS=1 TEXTURES=1 FILTER=2 WIDE_TEXELS=1 LANES=16 TRANSFORMS=1
// compile: PLANES=511 MATERIALS=0 NORMALS=0 TANGENTS=0 UV_SETS=1 COLORS=0 TEXTURES=1 FILTER=1 WIDE_TEXELS=0 LANES=1 TRANSFORMS=0
// compile: PLANES=511 MATERIALS=0 NORMALS=1 TANGENTS=0 UV_SETS=0 COLORS=0 TEXTURES=0 LANES=8 TRANSFORMS=1
// compile: PLANES=12 MATERIALS=1 NORMALS=0 TANGENTS=0 UV_SETS=1 COLORS=1 TEXTURES=1 FILTER=0 WIDE_TEXELS=1 LANES=1 TRANSFORMS=1
// compile: PLANES=1 MATERIALS=0 NORMALS=0 TANGENTS=0 UV_SETS=0 COLORS=0 TEXTURES=0 LANES=16 TRANSFORMS=0
#include "render/pixel_beam.h"

#if !defined(PLANES) || !defined(GROUP_SIZE)
#error "define PLANES and GROUP_SIZE"
#endif

#define HAS_SPOTS (PLANES & (4 | 8 | 32))

/// One pixel of the planes in each lane; 0 where there is no hit.
typedef struct Pixels {
    Vector position, geometric_normal, shading_normal, albedo;
    float4 uv_derivatives[LANES];
    uint material[LANES];
} Pixels;

/// What the planes show of hits, of which at least one is one; anything in the other lanes.
INLINE void find_pixels(const SceneArrays* scene, global const CameraRecord* camera, const Vector* direction,
                        const Hits* hits, float fraction, Pixels* pixels) {
    Triangles triangles;
    load_triangles(scene->positions, scene->triangles, scene->meshes, scene->instances, hits, &triangles);
    material_numbers(scene, &triangles, pixels->material);
#if HAS_SPOTS
    Spot spots[LANES];
    Beam beam;
    pixel_beam(camera, direction, hits->t, fraction, &beam);
    find_spots(&triangles, pixels->material, direction, hits, &beam, spots);
#endif
#if PLANES & 7
    Surface surface;
    find_surface(&triangles, direction, hits, &surface);
    pixels->position = surface.point;
    pixels->geometric_normal = surface.normal;
#endif
#if PLANES & 4
    Vector view = *direction;
    normalise_any3(&view);
    shading_normal(scene, &triangles, hits, spots, &surface, &view, &pixels->shading_normal);
#endif
#if PLANES & 8
    float alpha[LANES];
    colors_at(scene, spots, &pixels->albedo, alpha);
#endif
#if UV_SETS && (PLANES & 32)
    for (uint lane = 0; lane < LANES; ++lane) {
        float2 uv, along_x, along_y;
        uv_at(scene, spots + lane, 0, &uv, &along_x, &along_y);
        pixels->uv_derivatives[lane] = (float4)(along_x, along_y);
    }
#endif
}

/// What the planes show of no hit.
INLINE void null_pixels(Pixels* pixels) {
    const Vector zero = {(real)(0.0f), (real)(0.0f), (real)(0.0f)};
    pixels->position = pixels->geometric_normal = pixels->shading_normal = pixels->albedo = zero;
    for (uint lane = 0; lane < LANES; ++lane) {
        pixels->uv_derivatives[lane] = (float4)(0.0f);
        pixels->material[lane] = BOXWOOD_NONE;
    }
}

/// The same where `condition` holds, of pixels that have values.
INLINE void clear_pixels(mask condition, Pixels* pixels) {
    const Vector zero = {(real)(0.0f), (real)(0.0f), (real)(0.0f)};
    choose3(condition, &zero, &pixels->position);
    choose3(condition, &zero, &pixels->geometric_normal);
    choose3(condition, &zero, &pixels->shading_normal);
    choose3(condition, &zero, &pixels->albedo);
    int clears[LANES];
    STORE_LANES(condition, clears);
    for (uint lane = 0; lane < LANES; ++lane) {
        if (!clears[lane]) continue;
        pixels->uv_derivatives[lane] = (float4)(0.0f);
        pixels->material[lane] = BOXWOOD_NONE;
    }
}

/// Element i of every plane is what rays[i] met at hits[i]. A work-item writes `length` consecutive ones of the
/// `count`. No barriers: work-items share nothing.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void g_buffer(SCENE_PARAMETERS, global const CameraRecord* camera, global const Ray* rays, global const Hit* hits,
              uint count, uint length, float fraction, global float* out_positions, global float* geometric_normals,
              global float* shading_normals, global float* albedos, global float* depths, global float* uv_derivatives,
              global uint* out_materials, global uint* out_instances, global uint* primitives) {
    const SceneArrays scene = SCENE_ARRAYS;
    const ulong begin = (ulong)get_global_id(0) * length;
    const ulong end = min(begin + length, (ulong)count);
    for (ulong i = begin; i < end; i += LANES) {
        const uint used = (uint)min((ulong)LANES, end - i);
        uint index[LANES];
        lane_indices((uint)i, used, index);
        Rays view;
        Hits met;
        Pixels pixels;
        load_rays(rays, index, &view);
        load_hits(hits, index, &met);
        null_pixels(&pixels);
        if (ANY(met.some)) find_pixels(&scene, camera, &view.direction, &met, fraction, &pixels);
        clear_pixels(NOT(met.some), &pixels);
#if PLANES & 1
        store_vectors(&pixels.position, out_positions, 3, index, used);
#endif
#if PLANES & 2
        store_vectors(&pixels.geometric_normal, geometric_normals, 3, index, used);
#endif
#if PLANES & 4
        store_vectors(&pixels.shading_normal, shading_normals, 3, index, used);
#endif
#if PLANES & 8
        store_vectors(&pixels.albedo, albedos, 3, index, used);
#endif
        for (uint k = 0; k < used; ++k) {
#if PLANES & 16
            depths[i + k] = hits[i + k].t;
#endif
#if PLANES & 32
            vstore4(pixels.uv_derivatives[k], i + k, uv_derivatives);
#endif
#if PLANES & 64
            out_materials[i + k] = pixels.material[k];
#endif
#if PLANES & 128
            out_instances[i + k] = hits[i + k].instance;
#endif
#if PLANES & 256
            primitives[i + k] = hits[i + k].primitive;
#endif
        }
    }
}
