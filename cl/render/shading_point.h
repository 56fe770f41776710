// SPDX-License-Identifier: MIT
// The surfaces that rays hit, as shading sees them, one per lane: interpolated attributes of the vertices and the
// material at that point (dissertation 3.7.6). Macros: render/scene_arrays.h, and render/texture.h when TEXTURES is 1.
#ifndef BOXWOOD_RENDER_SHADING_POINT_H
#define BOXWOOD_RENDER_SHADING_POINT_H
#include "render/spot.h"
#include "render/surface.h"

/// Surfaces and their materials. Everything is finite, colours are linear and not negative.
typedef struct ShadingPoint {
    Surface surface;
    Vector normal; ///< For shading: normalised, on the side that the ray came from, never turned away from it.
#if NORMALS
    Vector smooth; ///< That of the vertices alone, on the same side; of another length.
    Vector lift;   ///< From the triangle to the smooth surface that it stands for; see smooth_lift.
#endif
    Vector base_color; ///< [0, 1]
    Vector emission;   ///< Radiance towards the ray's origin.
    real alpha;        ///< Share of the light that the surface stops: 0 or 1 unless it blends.
    real metallic;     ///< [0, 1]
    real roughness;    ///< [0, 1], perceptual
    real specular;     ///< [0, 1]
    real occlusion;    ///< [0, 1], 1 where nothing is occluded
    mask unlit;        ///< Shown as it is.
} ShadingPoint;

/// Cross-section of the beam that a ray stands for, where it meets the surface: two vectors from one side of the beam
/// to the other, for a pixel those to its neighbours (Igehy 1999). Read for textures only.
typedef struct Beam {
    Vector x, y;
    /// Emission and alpha are read as under a beam without width: lights and shadow rays read them so, and what both
    /// find must be the same. (Cut-outs have another size when they are filtered.)
    mask exact_light;
    /// Textures are filtered along both axes, if the filter is: for what is seen as a picture, by the camera or in a
    /// mirror. Other beams are wide anyway, and averaged.
    mask sharp;
} Beam;

INLINE void material_numbers(const SceneArrays* scene, const Triangles* triangles, uint* material) {
    for (uint lane = 0; lane < LANES; ++lane) {
#if MATERIALS
        material[lane] = scene->triangle_materials[triangles->number[lane]];
#else
        material[lane] = 0;
#endif
    }
}

#if UV_SETS
/// How the weights of the second and third vertex change along `v`, by its projection along the ray's direction onto
/// the triangle. Everything in object space, and in a measure in which the edges are near 1.
INLINE void weight_change(const Vector* edge1, const Vector* edge2, const Vector* normal, const Vector* direction,
                          const Vector* v, float change[2][LANES]) {
    Vector on_plane = *v, across;
    add_scaled3(-dot3(normal, v) / dot3(normal, direction), direction, &on_plane);
    const real square = dot3(normal, normal);
    cross3(&on_plane, edge2, &across);
    const real second = dot3(&across, normal) / square;
    cross3(edge1, &on_plane, &across);
    const real third = dot3(&across, normal) / square;
    // A beam along the surface has no end on it, nor has one on a triangle without area.
    const mask fine = (fabs(second) < INFINITY) & (fabs(third) < INFINITY);
    STORE_LANES(CHOOSE(fine, second, (real)(0.0f)), change[0]);
    STORE_LANES(CHOOSE(fine, third, (real)(0.0f)), change[1]);
}

INLINE void place_beam(const Triangles* triangles, const Vector* along, const Beam* beam, float change_x[2][LANES],
                       float change_y[2][LANES]) {
    // Weights do not change with the size of the triangle and of the beam together.
    const real largest = larger(largest3(&triangles->edge1), largest3(&triangles->edge2));
    const real scale = inverse_power(smaller(power_below(largest), (real)(0x1p126f)));
    Vector edge1 = triangles->edge1, edge2 = triangles->edge2, normal, direction, x, y;
    scale3(scale, &edge1);
    scale3(scale, &edge2);
    cross3(&edge1, &edge2, &normal);
    vector_to_object(triangles, along, &direction);
    normalise_any3(&direction);
    vector_to_object(triangles, &beam->x, &x);
    vector_to_object(triangles, &beam->y, &y);
    scale3(scale, &x);
    scale3(scale, &y);
    weight_change(&edge1, &edge2, &normal, &direction, &x, change_x);
    weight_change(&edge1, &edge2, &normal, &direction, &y, change_y);
}
#endif

/// The spots of the hits, for what is not done in lanes.
INLINE void find_spots(const Triangles* triangles, const uint* material, const Vector* direction, const Hits* hits,
                       const Beam* beam, Spot* spots) {
    float u[LANES], v[LANES];
    STORE_LANES(hits->u, u);
    STORE_LANES(hits->v, v);
#if UV_SETS
    float change_x[2][LANES], change_y[2][LANES];
    place_beam(triangles, direction, beam, change_x, change_y);
#else
    (void)direction;
    (void)beam;
#endif
#if TEXTURES
    int exact_light[LANES], sharp[LANES];
    STORE_LANES(beam->exact_light, exact_light);
    STORE_LANES(beam->sharp, sharp);
#endif
    for (uint lane = 0; lane < LANES; ++lane) {
        spots[lane].corner =
            (uint3)(triangles->corner[0][lane], triangles->corner[1][lane], triangles->corner[2][lane]);
        spots[lane].weight = (float3)(1.0f - u[lane] - v[lane], u[lane], v[lane]);
        spots[lane].material = material[lane];
#if UV_SETS
        spots[lane].weight_x = (float2)(change_x[0][lane], change_x[1][lane]);
        spots[lane].weight_y = (float2)(change_y[0][lane], change_y[1][lane]);
#endif
#if TEXTURES
        spots[lane].exact_light = exact_light[lane] != 0;
        spots[lane].sharp = sharp[lane] != 0;
#endif
    }
}

#if NORMALS
/// Vertex attributes from float `at` on, interpolated and normalised; zero stays zero.
INLINE void interpolate_direction(const SceneArrays* scene, const Triangles* triangles, const Hits* hits, uint at,
                                  Vector* direction) {
    Vector second, third;
    load_vectors(scene->attributes + at, VERTEX_FLOATS, triangles->corner[0], direction);
    load_vectors(scene->attributes + at, VERTEX_FLOATS, triangles->corner[1], &second);
    load_vectors(scene->attributes + at, VERTEX_FLOATS, triangles->corner[2], &third);
    scale3(1.0f - hits->u - hits->v, direction);
    add_scaled3(hits->u, &second, direction);
    add_scaled3(hits->v, &third, direction);
    normalise_any3(direction);
}

/// The normals that vertices say: `object` in object space, of the triangles where they say none; `world` in world
/// space, of another length. Returns 1, or -1 where that is not on the ray's side.
INLINE real vertex_normal(const SceneArrays* scene, const Triangles* triangles, const Hits* hits,
                          const Surface* surface, Vector* object, Vector* world) {
    Vector flat;
    interpolate_direction(scene, triangles, hits, NORMAL_AT, object);
    object_normal(triangles, &flat);
    normalise_any3(&flat);
    choose3(NOT(largest3(object) > 0.0f), &flat, object);
    normal_to_world(triangles, object, world);
    return CHOOSE(dot3(world, &surface->normal) < 0.0f, (real)(-1.0f), (real)(1.0f));
}

// Cosine of the angle between a triangle and the normals of its vertices from which on these are no smooth surface's,
// but an edge's or made to shade foliage.
#define LEAST_SMOOTH 0x1.6a09e6p-1f

/// From the points of triangles to the smooth surface that their vertices' normals stand for, in world space: rays that
/// start there see the light that those normals promise, where the triangle itself is turned away from it (Hanika 2021,
/// "Hacking the Shadow Terminator"). A point is moved onto the tangent planes of the vertices that it is below, by
/// their weights; planes stay planes, so that the space does not matter. `side` as from vertex_normal. Zero where the
/// surface is hollow.
INLINE void smooth_lift(const SceneArrays* scene, const Triangles* triangles, const Hits* hits, real side,
                        Vector* lift) {
    const real zero = 0.0f;
    const real weight[3] = {1.0f - hits->u - hits->v, hits->u, hits->v};
    Vector flat, sum = {zero, zero, zero};
    object_normal(triangles, &flat);
    normalise_any3(&flat);
    real least = 1.0f, greatest = -1.0f;
    for (uint k = 0; k < 3; ++k) {
        Vector normal, from = {zero, zero, zero};
        load_vectors(scene->attributes + NORMAL_AT, VERTEX_FLOATS, triangles->corner[k], &normal);
        add_scaled3(weight[1] - (k == 1 ? 1.0f : 0.0f), &triangles->edge1, &from);
        add_scaled3(weight[2] - (k == 2 ? 1.0f : 0.0f), &triangles->edge2, &from);
        add_scaled3(-weight[k] * side * smaller(side * dot3(&from, &normal), zero), &normal, &sum);
        const real cosine = dot3(&normal, &flat);
        least = smaller(least, cosine);
        greatest = larger(greatest, cosine);
    }
    const Vector none = {zero, zero, zero};
    choose3(NOT((least > LEAST_SMOOTH) | (greatest < -LEAST_SMOOTH)), &none, &sum);
    vector_to_world(triangles, &sum, lift);
}
#endif

#if TANGENTS
/// Bends the normal, `object` before it went to world space, by the normal textures.
INLINE void bend_normal(const SceneArrays* scene, const Triangles* triangles, const Hits* hits, const Spot* spots,
                        const Vector* object, Vector* normal) {
    float slope_x[LANES], slope_y[LANES], height[LANES], handedness[LANES];
    int has[LANES];
    for (uint lane = 0; lane < LANES; ++lane) {
        global const MaterialRecord* material = scene->materials + spots[lane].material;
        global const TextureInput* input = material->textures + BOXWOOD_NORMAL;
        const float4 texel = texture_at(scene, spots + lane, input);
        slope_x[lane] = material->normal_scale * (2.0f * texel.x - 1.0f);
        slope_y[lane] = material->normal_scale * (2.0f * texel.y - 1.0f);
        height[lane] = fmax(2.0f * texel.z - 1.0f, 0.0f);
        const float sign = scene->attributes[(ulong)spots[lane].corner.x * VERTEX_FLOATS + TANGENT_AT + 3];
        handedness[lane] = sign < 0.0f ? -1.0f : 1.0f;
        has[lane] = input->texture != BOXWOOD_NONE;
    }
    Vector tangent, bitangent, along, across;
    interpolate_direction(scene, triangles, hits, TANGENT_AT, &tangent);
    cross3(object, &tangent, &bitangent);
    // The bitangent is a direction on the surface, so that a mirrored instance mirrors its bumps.
    scale3(LOAD_LANES(handedness), &bitangent);
    vector_to_world(triangles, &tangent, &along);
    vector_to_world(triangles, &bitangent, &across);
    normalise_any3(&along);
    normalise_any3(&across);
    Vector bent = *normal;
    normalise_any3(&bent);
    scale3(LOAD_LANES(height), &bent);
    add_scaled3(LOAD_LANES(slope_x), &along, &bent);
    add_scaled3(LOAD_LANES(slope_y), &across, &bent);
    choose3((LOAD_LANES(has) != 0) & (largest3(&tangent) > 0.0f), &bent, normal);
}
#endif

/// The normals for shading, from vertices and normal textures, in world space and normalised, or those of the triangles
/// where those are zero. `view` goes along the rays.
INLINE void shading_normal(const SceneArrays* scene, const Triangles* triangles, const Hits* hits, const Spot* spots,
                           const Surface* surface, const Vector* view, Vector* normal) {
    *normal = surface->normal;
#if NORMALS
    Vector object, bent;
    // By the surface itself: a normal texture may bend the normal past the triangle's plane.
    const real side = vertex_normal(scene, triangles, hits, surface, &object, &bent);
#if TANGENTS
    bend_normal(scene, triangles, hits, spots, &object, &bent);
#endif
    normalise_any3(&bent);
    scale3(side, &bent);
    choose3(largest3(&bent) > 0.0f, &bent, normal);
#else
    (void)scene;
    (void)triangles;
    (void)hits;
#endif
#if !TANGENTS
    (void)spots;
#endif
    // Towards a silhouette interpolated normals turn away from the eye: they are bent back until they graze.
    const real grazing = 0x1p-7f, facing = -dot3(normal, view);
    Vector back = *normal;
    add_scaled3(facing - grazing, view, &back);
    normalise_any3(&back);
    choose3(facing < grazing, &back, normal);
}

/// What materials have without textures. Returns their flags.
INLINE whole load_material(const SceneArrays* scene, const uint* material, ShadingPoint* point) {
    const uint stride = sizeof(MaterialRecord) / sizeof(float);
    real row[8];
    load_rows8(scene->materials->base_color, stride, material, row);
    for (uint k = 0; k < 4; ++k) row[k] = clamp(row[k], 0.0f, 1.0f);
    const Vector color = {row[0], row[1], row[2]}, emission = {row[4], row[5], row[6]};
    point->base_color = color;
    point->alpha = row[3];
    point->emission = emission;
    point->metallic = row[7];
    load_rows8(&scene->materials->roughness, stride, material, row);
    point->roughness = row[0];
    point->specular = row[4];
    point->occlusion = 1.0f;
    return AS_WHOLE(row[5]);
}

#if TEXTURES
/// A texture of each lane's material; channel by channel.
INLINE void textures_at(const SceneArrays* scene, const Spot* spots, uint which, float texel[3][LANES]) {
    for (uint lane = 0; lane < LANES; ++lane) {
        Spot spot = spots[lane];
        if (which == BOXWOOD_EMISSION) light_spot(spots + lane, &spot);
        const float4 t = texture_at(scene, &spot, scene->materials[spot.material].textures + which);
        texel[0][lane] = t.x;
        texel[1][lane] = t.y;
        texel[2][lane] = t.z;
    }
}

INLINE void apply_textures(const SceneArrays* scene, const Spot* spots, ShadingPoint* point) {
    float texel[3][LANES], strength[LANES];
    textures_at(scene, spots, BOXWOOD_METALLIC_ROUGHNESS, texel);
    point->roughness *= LOAD_LANES(texel[1]);
    point->metallic *= LOAD_LANES(texel[2]);
    textures_at(scene, spots, BOXWOOD_EMISSION, texel);
    const Vector emission = {LOAD_LANES(texel[0]), LOAD_LANES(texel[1]), LOAD_LANES(texel[2])};
    multiply3(&emission, &point->emission, &point->emission);
    textures_at(scene, spots, BOXWOOD_OCCLUSION, texel);
    for (uint lane = 0; lane < LANES; ++lane)
        strength[lane] = scene->materials[spots[lane].material].occlusion_strength;
    point->occlusion = 1.0f + LOAD_LANES(strength) * (LOAD_LANES(texel[0]) - 1.0f);
}
#endif

/// The colours of spots, and their alphas before the alpha mode.
INLINE void colors_at(const SceneArrays* scene, const Spot* spots, Vector* result, float* alpha) {
    float color[3][LANES];
    for (uint lane = 0; lane < LANES; ++lane) {
        const float4 c = color_at(scene, spots + lane);
        color[0][lane] = c.x;
        color[1][lane] = c.y;
        color[2][lane] = c.z;
        alpha[lane] = c.w;
    }
    const Vector found = {LOAD_LANES(color[0]), LOAD_LANES(color[1]), LOAD_LANES(color[2])};
    *result = found;
}

/// Base colour with alpha as textures, vertices and the alpha mode make them.
INLINE void find_color(const SceneArrays* scene, const Spot* spots, const uint* material, whole flags,
                       ShadingPoint* point) {
    float alpha[LANES];
    STORE_LANES(point->alpha, alpha);
#if TEXTURES || COLORS
    colors_at(scene, spots, &point->base_color, alpha);
#else
    (void)spots;
#endif
    point->alpha = 1.0f;
    if (!ANY((flags & (BOXWOOD_ALPHA_MASK | BOXWOOD_ALPHA_BLEND)) != 0)) return;
    for (uint lane = 0; lane < LANES; ++lane) {
#if TEXTURES
        Spot spot;
        light_spot(spots + lane, &spot);
        if (spot.exact_light) alpha[lane] = color_at(scene, &spot).w;
#endif
        alpha[lane] = stopped_fraction(scene->materials + material[lane], alpha[lane]);
    }
    point->alpha = LOAD_LANES(alpha);
}

/// The surfaces and their materials where rays along `direction`, which is normalised, met them.
INLINE void find_shading_point(const SceneArrays* scene, const Vector* direction, const Hits* hits, const Beam* beam,
                               ShadingPoint* point) {
    Triangles triangles;
    load_triangles(scene->positions, scene->triangles, scene->meshes, scene->instances, hits, &triangles);
    uint material[LANES];
    material_numbers(scene, &triangles, material);
    Spot spots[LANES];
#if TEXTURES || COLORS
    find_spots(&triangles, material, direction, hits, beam, spots);
#else
    (void)beam;
#endif
    find_surface(&triangles, direction, hits, &point->surface);
    shading_normal(scene, &triangles, hits, spots, &point->surface, direction, &point->normal);
#if NORMALS
    Vector object;
    const real side = vertex_normal(scene, &triangles, hits, &point->surface, &object, &point->smooth);
    scale3(side, &point->smooth);
    smooth_lift(scene, &triangles, hits, side, &point->lift);
#endif
    const whole flags = load_material(scene, material, point);
    find_color(scene, spots, material, flags, point);
#if TEXTURES
    apply_textures(scene, spots, point);
#endif
    point->unlit = (flags & BOXWOOD_UNLIT) != 0;
    const Vector dark = {(real)(0.0f), (real)(0.0f), (real)(0.0f)};
    choose3(NOT(point->surface.front) & ((flags & BOXWOOD_DOUBLE_SIDED) == 0), &dark, &point->emission);
}

#endif
