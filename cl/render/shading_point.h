// SPDX-License-Identifier: MIT
// The surface that a ray met as shading sees it: the interpolated attributes of its vertices and its material at that point
// (dissertation 3.7.6). Macros: render/scene_arrays.h, and render/texture.h when TEXTURES is 1.
#ifndef BOXWOOD_RENDER_SHADING_POINT_H
#define BOXWOOD_RENDER_SHADING_POINT_H
#include "render/scene_arrays.h"
#include "render/surface.h"
#if TEXTURES
#include "render/texture.h"
#endif

/// A surface and its material at one point. Everything is finite, colours are linear and not negative.
typedef struct ShadingPoint {
    Surface surface;
    float3 normal;     ///< For shading: normalised, on the side that the ray came from, never turned away from it.
    float3 base_color; ///< [0, 1]
    float alpha;       ///< Share of the light that the surface stops: 0 or 1 unless it blends.
    float3 emission;   ///< Radiance towards the ray's origin.
    float metallic;    ///< [0, 1]
    float roughness;   ///< [0, 1], perceptual
    float specular;    ///< [0, 1]
    float occlusion;   ///< [0, 1], 1 where nothing is occluded
    uint material;     ///< Index into the materials.
    uint flags;        ///< MaterialRecord::flags
} ShadingPoint;

/// Cross-section of the beam that a ray stands for, where it meets the surface: two vectors from one side of the beam to the
/// other, for a pixel those to its neighbours (Igehy 1999). Read for textures only.
typedef struct Beam {
    float3 x, y;
} Beam;

/// The triangle of a hit within the arrays, and where on it the hit is.
typedef struct Place {
    uint3 corner; ///< Vertices.
    float3 weight; ///< Their barycentric weights.
    uint material;
#if UV_SETS
    // Change of the second and third weight along the two vectors of a beam.
    float2 weight_x, weight_y;
#endif
} Place;

INLINE float3 rotate_rows(global const float* rows, float3 v) {
    return (float3)(dot(vload3(0, rows), v), dot(vload3(0, rows + 4), v), dot(vload3(0, rows + 8), v));
}

/// rows^T v: to_object's take normals to world space.
INLINE float3 rotate_columns(global const float* rows, float3 v) {
    return v.x * vload3(0, rows) + v.y * vload3(0, rows + 4) + v.z * vload3(0, rows + 8);
}

INLINE void place_of(const SceneArrays* scene, Hit hit, Place* place) {
    const uint triangle = scene->meshes[scene->instances[hit.instance].mesh].first_triangle + hit.primitive;
    place->corner = vload3(triangle, scene->triangles);
    place->weight = (float3)(1.0f - hit.u - hit.v, hit.u, hit.v);
#if MATERIALS
    place->material = scene->triangle_materials[triangle];
#else
    place->material = 0;
#endif
}

#if UV_SETS
/// How the weights change along `v`, a vector in world space: by its projection along the ray's direction onto the triangle.
INLINE float2 weight_change(float3 edge1, float3 edge2, float3 normal, float3 direction, float3 v) {
    const float facing = dot(normal, direction);
    const float3 on_plane = v - direction * (dot(normal, v) / facing);
    const float square = dot(normal, normal);
    const float2 change = (float2)(dot(cross(on_plane, edge2), normal), dot(cross(edge1, on_plane), normal)) / square;
    // A beam along the surface has no end on it, nor has one on a triangle without area.
    return (isfinite(change.x) && isfinite(change.y)) ? change : (float2)(0.0f);
}

INLINE void place_beam(const SceneArrays* scene, float3 along, Hit hit, Beam beam, Place* place) {
    global const float* rows = scene->instances[hit.instance].to_object;
    const float3 v0 = vload3(place->corner.x, scene->positions);
    const float3 edge1 = vload3(place->corner.y, scene->positions) - v0;
    const float3 edge2 = vload3(place->corner.z, scene->positions) - v0;
    // Weights do not change with the size of the triangle and of the beam together.
    const float largest = fmax(fmax(fmax(fabs(edge1.x), fabs(edge1.y)), fmax(fabs(edge1.z), fabs(edge2.x))),
                               fmax(fabs(edge2.y), fabs(edge2.z)));
    const float scale = largest > 0.0f ? 1.0f / largest : 0.0f;
    const float3 normal = cross(edge1 * scale, edge2 * scale);
    const float3 direction = normalize_any(rotate_rows(rows, along));
    place->weight_x = weight_change(edge1 * scale, edge2 * scale, normal, direction, rotate_rows(rows, beam.x) * scale);
    place->weight_y = weight_change(edge1 * scale, edge2 * scale, normal, direction, rotate_rows(rows, beam.y) * scale);
}

INLINE float2 vertex_uv(const SceneArrays* scene, uint vertex, uint set) {
    return vload2(0, scene->attributes + (ulong)vertex * VERTEX_FLOATS + UV_AT + 2 * set);
}
#endif

INLINE float3 vertex_vector(const SceneArrays* scene, uint vertex, uint at) {
    return vload3(0, scene->attributes + (ulong)vertex * VERTEX_FLOATS + at);
}

INLINE float3 interpolate_vector(const SceneArrays* scene, const Place* place, uint at) {
    return place->weight.x * vertex_vector(scene, place->corner.x, at) +
           place->weight.y * vertex_vector(scene, place->corner.y, at) +
           place->weight.z * vertex_vector(scene, place->corner.z, at);
}

#if TEXTURES
/// The texture of an input at the place, (1, 1, 1, 1) without one.
INLINE float4 texture_at(const SceneArrays* scene, const Place* place, global const TextureInput* input) {
    if (input->texture == BOXWOOD_NONE) return (float4)(1.0f);
    const float2 uv0 = vertex_uv(scene, place->corner.x, input->uv_set);
    const float2 edge1 = vertex_uv(scene, place->corner.y, input->uv_set) - uv0;
    const float2 edge2 = vertex_uv(scene, place->corner.z, input->uv_set) - uv0;
    const float2 uv = uv0 + place->weight.y * edge1 + place->weight.z * edge2;
    const float2 along_x = place->weight_x.x * edge1 + place->weight_x.y * edge2;
    const float2 along_y = place->weight_y.x * edge1 + place->weight_y.y * edge2;
    global const float* rows = input->rows;
    const float2 u = (float2)(rows[0], rows[1]), v = (float2)(rows[3], rows[4]);
    return sample_texture(scene->textures + input->texture, scene->texels,
                          (float2)(dot(u, uv) + rows[2], dot(v, uv) + rows[5]),
                          (float2)(dot(u, along_x), dot(v, along_x)), (float2)(dot(u, along_y), dot(v, along_y)));
}
#endif

/// Base colour with alpha, before the alpha mode.
INLINE float4 color_at(const SceneArrays* scene, const Place* place) {
    global const MaterialRecord* material = scene->materials + place->material;
    float4 color = vload4(0, material->base_color);
#if TEXTURES
    color *= texture_at(scene, place, material->textures + BOXWOOD_BASE_COLOR);
#endif
#if COLORS
    const ulong at = COLOR_AT;
    color *= place->weight.x * vload4(0, scene->attributes + (ulong)place->corner.x * VERTEX_FLOATS + at) +
             place->weight.y * vload4(0, scene->attributes + (ulong)place->corner.y * VERTEX_FLOATS + at) +
             place->weight.z * vload4(0, scene->attributes + (ulong)place->corner.z * VERTEX_FLOATS + at);
#endif
    return clamp(color, 0.0f, 1.0f);
}

/// What the alpha mode makes of an alpha.
INLINE float stopped_share(global const MaterialRecord* material, float alpha) {
    if (material->flags & BOXWOOD_ALPHA_BLEND) return alpha;
    if (material->flags & BOXWOOD_ALPHA_MASK) return alpha < material->alpha_cutoff ? 0.0f : 1.0f;
    return 1.0f;
}

#if NORMALS
/// Normal of the triangle in object space, for vertices without any.
INLINE float3 object_normal(const SceneArrays* scene, const Place* place) {
    const float3 v0 = vload3(place->corner.x, scene->positions);
    return normalize_any(cross(scaled_by_largest(vload3(place->corner.y, scene->positions) - v0),
                               scaled_by_largest(vload3(place->corner.z, scene->positions) - v0)));
}
#endif

/// The normal for shading, from vertices and normal texture, in world space and normalised, or that of the triangle where those
/// are zero. `view` goes along the ray.
INLINE float3 shading_normal(const SceneArrays* scene, const Place* place, Hit hit, Surface surface, float3 view) {
    float3 normal = surface.normal;
#if NORMALS
    global const InstanceRecord* instance = scene->instances + hit.instance;
    const float3 interpolated = normalize_any(interpolate_vector(scene, place, NORMAL_AT));
    const float3 object = dot(interpolated, interpolated) > 0.0f ? interpolated : object_normal(scene, place);
    float3 bent = rotate_columns(instance->to_object, object);
    // By the surface itself: a normal texture may bend the normal past the triangle's plane.
    const bool turned = dot(bent, surface.normal) < 0.0f;
#if TANGENTS
    global const MaterialRecord* material = scene->materials + place->material;
    const float3 tangent = normalize_any(interpolate_vector(scene, place, TANGENT_AT));
    if (material->textures[BOXWOOD_NORMAL].texture != BOXWOOD_NONE && dot(tangent, tangent) > 0.0f) {
        const float4 texel = texture_at(scene, place, material->textures + BOXWOOD_NORMAL);
        const float2 slope = material->normal_scale * (2.0f * texel.xy - 1.0f);
        const float handedness =
            scene->attributes[(ulong)place->corner.x * VERTEX_FLOATS + TANGENT_AT + 3] < 0.0f ? -1.0f : 1.0f;
        // The bitangent is a direction on the surface, so that a mirrored instance mirrors its bumps.
        bent = fmax(2.0f * texel.z - 1.0f, 0.0f) * normalize_any(bent) +
               slope.x * normalize_any(rotate_rows(instance->to_world, tangent)) +
               slope.y * normalize_any(rotate_rows(instance->to_world, handedness * cross(object, tangent)));
    }
#endif
    bent = normalize_any(bent);
    if (dot(bent, bent) > 0.0f) normal = turned ? -bent : bent;
#else
    (void)scene;
    (void)place;
    (void)hit;
#endif
    // Towards a silhouette interpolated normals turn away from the eye: they are bent back until they graze.
    const float grazing = 0x1p-7f, facing = -dot(normal, view);
    return facing < grazing ? normalize_any(normal - view * (grazing - facing)) : normal;
}

/// The surface and its material where a ray along `direction`, which is normalised, met it; `hit` is not a miss.
INLINE void find_shading_point(const SceneArrays* scene, float3 direction, Hit hit, Beam beam, ShadingPoint* point) {
    Place place;
    place_of(scene, hit, &place);
#if UV_SETS
    place_beam(scene, direction, hit, beam, &place);
#else
    (void)beam;
#endif
    global const MaterialRecord* material = scene->materials + place.material;
    find_surface(scene->positions, scene->triangles, scene->meshes, scene->instances, direction, hit, &point->surface);
    point->normal = shading_normal(scene, &place, hit, point->surface, direction);
    point->material = place.material;
    point->flags = material->flags;
    const float4 color = color_at(scene, &place);
    point->base_color = color.xyz;
    point->alpha = stopped_share(material, color.w);
    point->metallic = material->metallic;
    point->roughness = material->roughness;
    point->specular = material->specular;
    point->occlusion = 1.0f;
    point->emission = vload3(0, material->emission);
#if TEXTURES
    const float4 metal = texture_at(scene, &place, material->textures + BOXWOOD_METALLIC_ROUGHNESS);
    point->metallic *= metal.z;
    point->roughness *= metal.y;
    point->emission *= texture_at(scene, &place, material->textures + BOXWOOD_EMISSION).xyz;
    const float occlusion = texture_at(scene, &place, material->textures + BOXWOOD_OCCLUSION).x;
    point->occlusion = 1.0f + material->occlusion_strength * (occlusion - 1.0f);
#endif
    if (!point->surface.front && !(material->flags & BOXWOOD_DOUBLE_SIDED)) point->emission = (float3)(0.0f);
}

INLINE void shading_point(const SceneArrays* scene, Ray ray, Hit hit, Beam beam, ShadingPoint* point) {
    find_shading_point(scene, normalize_any(vload3(0, ray.direction)), hit, beam, point);
}

#endif
