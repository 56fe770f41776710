// SPDX-License-Identifier: MIT
// One bounce of a path: what it gathers at a surface and where it goes on. Macros: those of the headers included here, and
//
// STRATEGY  how direct light is sampled: 0 both ways, with the power heuristic (Veach 1997); 1 towards lights; 2 by the surface
//           (lights without extent always towards them)
// LIGHTS    1: there are lights to sample towards
#ifndef BOXWOOD_RENDER_PATH_H
#define BOXWOOD_RENDER_PATH_H
#include "render/bsdf.h"
#include "render/environment.h"
#include "render/lights.h"
#include "render/pixel_beam.h"
#include "render/sampler.h"
#include "render/tangents.h"
#include "shared/path.h"

#if !defined(STRATEGY) || !defined(LIGHTS) || !defined(EMISSION)
#error "define STRATEGY (0 both, 1 lights, 2 surface), LIGHTS and EMISSION (0 or 1)"
#endif

// Whether the environment is sampled towards, and whether anything is.
#define SAMPLE_ENVIRONMENT (ENVIRONMENT && STRATEGY != 2)
#define NEXT_EVENT (LIGHTS || SAMPLE_ENVIRONMENT)
// The share of the samples that the lights have; the environment has the others.
#define LIGHT_SHARE (SAMPLE_ENVIRONMENT ? 0.5f : 1.0f)
#define ENVIRONMENT_SHARE (LIGHTS ? 0.5f : 1.0f)

// Dimensions of the sampler: four for each bounce, and one for each surface with alpha.
#define CHOICE_DIMENSION 0u // light and lobe
#define LIGHT_DIMENSION 1u
#define SCATTER_DIMENSION 2u
#define ROULETTE_DIMENSION 3u
#define BOUNCE_DIMENSIONS 4u
#define ALPHA_DIMENSION 0x8000u

// Bounce from which on paths end by chance.
#define ROULETTE_BOUNCE 3u

/// What all paths of a launch share.
typedef struct PathSettings {
    ulong seed;
    uint sample, samples, depth, first_pixel;
} PathSettings;

/// The world as a path sees it.
typedef struct PathWorld {
    SceneArrays scene;
#if LIGHTS
    LightArrays lights;
#endif
#if ENVIRONMENT
    EnvironmentArrays environment;
#endif
} PathWorld;

/// A Ray and a PathState as vectors: their arrays would be kept in memory.
typedef struct PathRay {
    float3 origin, direction;
    float t_min, t_max;
} PathRay;

typedef struct Path {
    float3 throughput;
    float pdf;
    uint pixel, counts;
    float width, spread;
} Path;

/// Where a path meets a surface: the frame of the shading normal, and the way back in it.
typedef struct Vertex {
    ShadingPoint point;
    float3 tangent, bitangent;
    float3 origin; ///< Of rays that leave.
    float3 wo;
    Bsdf bsdf;
} Vertex;

INLINE bool usable(float3 c) {
    return c.x >= 0.0f && c.y >= 0.0f && c.z >= 0.0f && c.x < INFINITY && c.y < INFINITY && c.z < INFINITY;
}

/// Weight of a sample of density `pdf` beside the other strategy's (the power heuristic with exponent 2).
INLINE float power_heuristic(float pdf, float other) {
    const float ratio = other / pdf;
    return 1.0f / (1.0f + ratio * ratio);
}

INLINE float3 into_frame(const Vertex* vertex, float3 v) {
    return (float3)(dot(v, vertex->tangent), dot(v, vertex->bitangent), dot(v, vertex->point.normal));
}

INLINE float3 out_of_frame(const Vertex* vertex, float3 v) {
    return v.x * vertex->tangent + v.y * vertex->bitangent + v.z * vertex->point.normal;
}

/// The beam of a cone of `width`.
INLINE void cone_beam(float3 direction, float width, Beam* beam) {
    tangents_of(direction, &beam->x, &beam->y);
    beam->x *= width;
    beam->y *= width;
}

INLINE void make_vertex(float3 direction, Vertex* vertex) {
    const ShadingPoint* point = &vertex->point;
    tangents_of(point->normal, &vertex->tangent, &vertex->bitangent);
    vertex->origin = surface_origin(point->surface);
    vertex->wo = into_frame(vertex, -direction);
    make_bsdf(point->base_color, point->metallic, point->roughness, point->specular, &vertex->bsdf);
}

/// Radiance that comes along a ray which met nothing, by its share among the strategies.
INLINE float3 sky_light(const PathWorld* world, float3 direction, bool first, float pdf) {
#if ENVIRONMENT
#if STRATEGY == 1
    if (!first) return (float3)(0.0f);
#endif
    float other;
    const float3 radiance = environment_light(&world->environment, direction, &other);
    (void)pdf;
    (void)first;
#if STRATEGY == 0
    if (!first) return power_heuristic(pdf, ENVIRONMENT_SHARE * other) * radiance;
#endif
    return radiance;
#else
    (void)world;
    (void)direction;
    (void)first;
    (void)pdf;
    return (float3)(0.0f);
#endif
}

/// Radiance that a surface sends back along a ray, by its share among the strategies.
INLINE float3 surface_light(const PathWorld* world, const ShadingPoint* point, float3 direction, Hit hit, bool first,
                            float pdf) {
    if (point->flags & BOXWOOD_UNLIT) return point->base_color;
    float3 light = point->emission;
#if EMISSION && LIGHTS && STRATEGY != 2
    if (!first && (light.x > 0.0f || light.y > 0.0f || light.z > 0.0f)) {
        const float cosine = -dot(direction, point->surface.normal);
        const float other = LIGHT_SHARE * triangle_pdf(&world->lights, hit, hit.t, cosine);
#if STRATEGY == 0
        light *= power_heuristic(pdf, other);
#else
        if (other > 0.0f) return (float3)(0.0f);
#endif
    }
#endif
    (void)world;
    (void)direction;
    (void)hit;
    (void)first;
    (void)pdf;
    return light;
}

/// Whether a hit may give light or let it pass: where no bounce is left, nothing else counts.
INLINE bool may_shine(const SceneArrays* scene, Hit hit) {
#if MATERIALS
    const uint triangle = scene->meshes[scene->instances[hit.instance].mesh].first_triangle + hit.primitive;
    global const MaterialRecord* material = scene->materials + scene->triangle_materials[triangle];
#else
    global const MaterialRecord* material = scene->materials;
    (void)hit;
#endif
    const float3 emission = vload3(0, material->emission);
    return emission.x > 0.0f || emission.y > 0.0f || emission.z > 0.0f ||
           (material->flags & (BOXWOOD_UNLIT | BOXWOOD_ALPHA_MASK | BOXWOOD_ALPHA_BLEND));
}

#if NEXT_EVENT
/// A shadow ray and the light that it stands for; false if there is none.
INLINE bool next_event(const PathWorld* world, const Vertex* vertex, float choice, float2 u, PathRay* ray, float3* light) {
    LightSample sample;
#if SAMPLE_ENVIRONMENT
#if LIGHTS
    const bool distant = choice >= LIGHT_SHARE;
    choice *= 2.0f;
#else
    const bool distant = true;
#endif
    if (distant) {
        const float3 radiance = sample_environment(&world->environment, vertex->point.surface.normal, u,
                                                   &sample.direction, &sample.pdf);
        sample.pdf *= ENVIRONMENT_SHARE;
        sample.segment = sample.direction;
        sample.t_max = INFINITY;
        sample.value = radiance / sample.pdf;
    }
#if LIGHTS
    else
#endif
#endif
#if LIGHTS
        sample_light(&world->scene, &world->lights, vertex->origin, choice, u, LIGHT_SHARE, &sample);
#endif
#if STRATEGY == 2
    if (sample.pdf > 0.0f) return false;
#endif
    if (!(dot(sample.direction, vertex->point.surface.normal) > 0.0f)) return false;
    float3 value;
    float pdf;
    evaluate_bsdf(&vertex->bsdf, vertex->wo, into_frame(vertex, sample.direction), &value, &pdf);
    *light = value * sample.value;
#if STRATEGY == 0
    if (sample.pdf > 0.0f) *light *= power_heuristic(sample.pdf, pdf);
#endif
    ray->origin = vertex->origin;
    ray->t_min = 0.0f;
    ray->direction = sample.segment;
    ray->t_max = sample.t_max;
    return usable(*light) && (light->x > 0.0f || light->y > 0.0f || light->z > 0.0f);
}
#endif

/// The next ray of a path, and what it does to its state; false where the path ends. `width` is that of the beam at the vertex.
INLINE bool scatter_path(const Vertex* vertex, const PathSettings* settings, const Sampler* sampler, uint dimension,
                         float choice, float width, Path* path, PathRay* ray) {
    float3 wi, value;
    float pdf;
    sample_bsdf(&vertex->bsdf, vertex->wo, choice, sample_square(sampler, dimension + SCATTER_DIMENSION), &wi);
    evaluate_bsdf(&vertex->bsdf, vertex->wo, wi, &value, &pdf);
    if (!(pdf > 0.0f)) return false;
    const float3 turned = out_of_frame(vertex, wi), direction = turned / sqrt(dot(turned, turned));
    if (!(dot(direction, vertex->point.surface.normal) > 0.0f)) return false;

    float3 throughput = path->throughput * (value / pdf);
    const float largest = fmax(fmax(throughput.x, throughput.y), throughput.z);
    if (!(largest > 0.0f) || !usable(throughput)) return false;
    path->counts += 1;
    if ((path->counts & 0xffffu) >= ROULETTE_BOUNCE && largest < 1.0f) {
        // A multiple of the spacing of samples, so that it is the chance to survive; and not so small that few carry much.
        const float survival = GREATER(ceil(largest * 0x1p24f) * 0x1p-24f, 0x1p-4f);
        if (sample_square(sampler, dimension + ROULETTE_DIMENSION).x >= survival) return false;
        throughput /= survival;
    }
    path->throughput = throughput;
    path->pdf = pdf;
#if TEXTURES
    // One of so many samples stands for this solid angle; a radian at most.
    path->width = width;
    path->spread = fmax(path->spread, fmin(1.0f / sqrt((float)settings->samples * pdf), 1.0f));
#else
    (void)width;
    (void)settings;
#endif
    ray->origin = vertex->origin;
    ray->t_min = 0.0f;
    ray->direction = direction;
    ray->t_max = INFINITY;
    return true;
}

#endif
