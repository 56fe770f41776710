// SPDX-License-Identifier: MIT
// One place on one triangle, and what attributes and textures say there (dissertation 3.7.6): texture by texture, not
// in lanes.
// Macros: render/scene_arrays.h, and render/texture.h when TEXTURES is 1.
#ifndef BOXWOOD_RENDER_SPOT_H
#define BOXWOOD_RENDER_SPOT_H
#include "render/scene_arrays.h"
#include "runtime/products.h"
#if TEXTURES
#include "render/texture.h"
#endif

typedef struct Spot {
    uint3 corner;  ///< Vertices of the triangle.
    float3 weight; ///< Their barycentric weights.
    uint material;
#if UV_SETS
    // Change of the second and third weight along the two vectors of a beam.
    float2 weight_x, weight_y;
#endif
#if TEXTURES
    bool exact_light, sharp; ///< See Beam.
#endif
} Spot;

/// The spot of weights (1 - u - v, u, v) under a beam without width.
INLINE void spot_of(const SceneArrays* scene, uint instance, uint primitive, float u, float v, Spot* spot) {
    const uint triangle = scene->meshes[scene->instances[instance].mesh].first_triangle + primitive;
    spot->corner = vload3(triangle, scene->triangles);
    spot->weight = (float3)(1.0f - u - v, u, v);
#if MATERIALS
    spot->material = scene->triangle_materials[triangle];
#else
    spot->material = 0;
#endif
#if UV_SETS
    spot->weight_x = spot->weight_y = (float2)(0.0f);
#endif
#if TEXTURES
    spot->exact_light = spot->sharp = true;
#endif
}

#if UV_SETS
/// Texture coordinates, and their change along the two vectors of the beam.
INLINE void uv_at(const SceneArrays* scene, const Spot* spot, uint set, float2* uv, float2* along_x, float2* along_y) {
    const ulong at = UV_AT + 2 * set;
    const float2 uv0 = vload2(0, scene->attributes + (ulong)spot->corner.x * VERTEX_FLOATS + at);
    const float2 edge1 = vload2(0, scene->attributes + (ulong)spot->corner.y * VERTEX_FLOATS + at) - uv0;
    const float2 edge2 = vload2(0, scene->attributes + (ulong)spot->corner.z * VERTEX_FLOATS + at) - uv0;
    *uv = uv0 + spot->weight.y * edge1 + spot->weight.z * edge2;
    *along_x = spot->weight_x.x * edge1 + spot->weight_x.y * edge2;
    *along_y = spot->weight_y.x * edge1 + spot->weight_y.y * edge2;
}
#endif

#if TEXTURES
/// The texture of an input at the spot, (1, 1, 1, 1) without one.
INLINE float4 texture_at(const SceneArrays* scene, const Spot* spot, global const TextureInput* input) {
    if (input->texture == BOXWOOD_NONE) return (float4)(1.0f);
    float2 uv, along_x, along_y;
    uv_at(scene, spot, input->uv_set, &uv, &along_x, &along_y);
    global const float* rows = input->rows;
    const float2 u = (float2)(rows[0], rows[1]), v = (float2)(rows[3], rows[4]);
    return sample_texture(scene->textures + input->texture, scene->texels,
                          (float2)(dot_float2(u, uv) + rows[2], dot_float2(v, uv) + rows[5]),
                          (float2)(dot_float2(u, along_x), dot_float2(v, along_x)),
                          (float2)(dot_float2(u, along_y), dot_float2(v, along_y)), spot->sharp);
}
#endif

#if TEXTURES
/// The spot as emission and alpha are read at it.
INLINE void light_spot(const Spot* spot, Spot* at) {
    *at = *spot;
    if (spot->exact_light) at->weight_x = at->weight_y = (float2)(0.0f);
}
#endif

/// Base colour with alpha, before the alpha mode.
INLINE float4 color_at(const SceneArrays* scene, const Spot* spot) {
    global const MaterialRecord* material = scene->materials + spot->material;
    float4 color = vload4(0, material->base_color);
#if TEXTURES
    color *= texture_at(scene, spot, material->textures + BOXWOOD_BASE_COLOR);
#endif
#if COLORS
    const ulong at = COLOR_AT;
    color *= spot->weight.x * vload4(0, scene->attributes + (ulong)spot->corner.x * VERTEX_FLOATS + at) +
             spot->weight.y * vload4(0, scene->attributes + (ulong)spot->corner.y * VERTEX_FLOATS + at) +
             spot->weight.z * vload4(0, scene->attributes + (ulong)spot->corner.z * VERTEX_FLOATS + at);
#endif
    return clamp(color, 0.0f, 1.0f);
}

/// What the alpha mode makes of an alpha: the fraction of the light that is stopped.
INLINE float stopped_fraction(global const MaterialRecord* material, float alpha) {
    if (material->flags & BOXWOOD_ALPHA_BLEND) return alpha;
    if (material->flags & BOXWOOD_ALPHA_MASK) return alpha < material->alpha_cutoff ? 0.0f : 1.0f;
    return 1.0f;
}

#endif
