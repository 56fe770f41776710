// SPDX-License-Identifier: MIT
// One bounce of paths, one path per lane: what they gather at a surface and where they go on. Macros: those of the
// headers included here, and
//
// STRATEGY  how direct light is sampled: 0 both ways, with the power heuristic (Veach 1997); 1 towards lights; 2 by the
//           surface (lights without extent always towards them)
// LIGHTS    1: there are lights to sample towards
#ifndef BOXWOOD_RENDER_PATH_H
#define BOXWOOD_RENDER_PATH_H
#define COMPENSATED (STRATEGY == 0)
#include "render/environment.h"
#include "render/lights.h"
#include "render/sampler.h"
#include "render/vertex.h"
#include "shared/path.h"

#if !defined(STRATEGY) || !defined(LIGHTS) || !defined(EMISSION)
#error "define STRATEGY (0 both, 1 lights, 2 surface), LIGHTS and EMISSION (0 or 1)"
#endif

// Whether the environment is sampled towards, and whether anything is.
#define SAMPLE_ENVIRONMENT (ENVIRONMENT && STRATEGY != 2)
#define NEXT_EVENT (LIGHTS || SAMPLE_ENVIRONMENT)

// Dimensions of the sampler: four for each bounce, and one for each surface that stops a part of the light.
#define CHOICE_DIMENSION 0u // lobe, and what the choice of a light takes of the digits of its point
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

/// A PathState in each lane.
typedef struct Paths {
    Vector throughput;
    real pdf, width, spread;
    whole pixel, bounces, layers;
} Paths;

INLINE mask usable(const Vector* c) {
    return (c->x >= 0.0f) & (c->y >= 0.0f) & (c->z >= 0.0f) & (c->x < INFINITY) & (c->y < INFINITY) & (c->z < INFINITY);
}

INLINE mask bright(const Vector* c) { return (c->x > 0.0f) | (c->y > 0.0f) | (c->z > 0.0f); }

/// Weight of a sample of density `pdf` beside the other strategy's (the power heuristic with exponent 2).
INLINE real power_heuristic(real pdf, real other) {
    const real ratio = other / pdf;
    return 1.0f / (1.0f + ratio * ratio);
}

/// How samples towards light are divided at a place.
INLINE void find_shares(const PathWorld* world, const Vector* place, LightProbabilities* probabilities) {
    const LightProbabilities sky = {(real)(SAMPLE_ENVIRONMENT ? 1.0f : 0.0f), (real)(0.0f), (real)(0.0f)};
    *probabilities = sky;
#if LIGHTS && SAMPLE_ENVIRONMENT
    light_probabilities(&world->lights.tree, drawn_irradiance(&world->environment), place, probabilities);
#elif LIGHTS
    light_probabilities(&world->lights.tree, 0.0f, place, probabilities);
#endif
    (void)world;
    (void)place;
}

/// Radiance that comes along rays which met nothing, by its fraction among the strategies.
INLINE void sky_light(const PathWorld* world, const Rays* rays, mask first, real pdf, Vector* light) {
#if ENVIRONMENT
    real other;
    environment_light(&world->environment, &rays->direction, light, &other);
#if STRATEGY == 0
    if (ANY(NOT(first))) {
        LightProbabilities probabilities;
        find_shares(world, &rays->origin, &probabilities);
        scale3(CHOOSE(first, (real)(1.0f), power_heuristic(pdf, probabilities.environment * other)), light);
    }
#elif STRATEGY == 1
    scale3(CHOOSE(first, (real)(1.0f), (real)(0.0f)), light);
#endif
#else
    const Vector none = {(real)(0.0f), (real)(0.0f), (real)(0.0f)};
    *light = none;
    (void)world;
    (void)rays;
#endif
    (void)first;
    (void)pdf;
}

/// Radiance that surfaces send back along rays, by its fraction among the strategies.
INLINE void surface_light(const PathWorld* world, const ShadingPoint* point, const Rays* rays, const Hits* hits,
                          mask first, real pdf, Vector* light) {
    *light = point->emission;
#if EMISSION && LIGHTS && STRATEGY != 2
    const mask shared = bright(light) & NOT(first);
    if (ANY(shared)) {
        const real cosine = -dot3(&rays->direction, &point->surface.normal);
        LightProbabilities probabilities;
        find_shares(world, &rays->origin, &probabilities);
        const real other = probabilities.near * triangle_pdf(&world->lights, &rays->origin, hits->instance,
                                                             hits->primitive, hits->t, cosine);
#if STRATEGY == 0
        scale3(CHOOSE(shared, power_heuristic(pdf, other), (real)(1.0f)), light);
#else
        scale3(CHOOSE(shared & (other > 0.0f), (real)(0.0f), (real)(1.0f)), light);
#endif
    }
#endif
    choose3(point->unlit, &point->base_color, light);
    (void)world;
    (void)rays;
    (void)hits;
    (void)first;
    (void)pdf;
}

/// Which hits may give light or let it pass: where no bounce is left, nothing else counts.
INLINE mask may_shine(const SceneArrays* scene, const Hits* hits) {
    int may[LANES];
    for (uint lane = 0; lane < LANES; ++lane) {
        Spot spot;
        spot_of(scene, hits->instance[lane], hits->primitive[lane], 0.0f, 0.0f, &spot);
        global const MaterialRecord* material = scene->materials + spot.material;
        may[lane] = material->emission[0] > 0.0f || material->emission[1] > 0.0f || material->emission[2] > 0.0f ||
                    (material->flags & (BOXWOOD_UNLIT | BOXWOOD_ALPHA_MASK | BOXWOOD_ALPHA_BLEND));
    }
    return LOAD_LANES(may) != 0;
}

#if NEXT_EVENT
/// Shadow rays and the light that they stand for, chosen by u and v (see sample_light). Returns where there is one.
INLINE mask next_event(const PathWorld* world, const Vertex* vertex, real u, real v, real low_bits, Rays* rays,
                       Vector* light) {
    LightProbabilities probabilities;
    find_shares(world, &vertex->origin, &probabilities);
    LightSample sample;
#if LIGHTS
    sample_light(&world->scene, &world->lights, &probabilities, &vertex->origin, u - probabilities.environment, v,
                 low_bits, &sample);
#else
    (void)low_bits;
#endif
#if SAMPLE_ENVIRONMENT
    const mask distant = (u < probabilities.environment) | (mask)(LIGHTS ? 0 : -1);
    LightSample sky;
    sample_environment(&world->environment, &vertex->point.normal,
                       smaller(u / probabilities.environment, (real)(BEFORE_ONE)), v, &sky.direction, &sky.value,
                       &sky.pdf);
    sky.pdf *= probabilities.environment;
    scale3(1.0f / sky.pdf, &sky.value);
#if LIGHTS
    choose3(distant, &sky.direction, &sample.segment);
    choose3(distant, &sky.direction, &sample.direction);
    choose3(distant, &sky.value, &sample.value);
    sample.t_max = CHOOSE(distant, (real)(INFINITY), sample.t_max);
    sample.pdf = CHOOSE(distant, sky.pdf, sample.pdf);
#else
    (void)distant;
    sample = sky;
    sample.segment = sky.direction;
    sample.t_max = INFINITY;
#endif
#endif
    Vector wi, value;
    real pdf;
    into_frame(vertex, &sample.direction, &wi);
    evaluate_bsdf(&vertex->bsdf, &vertex->wo, &wi, &value, &pdf);
    multiply3(&value, &sample.value, light);
#if STRATEGY == 0
    scale3(CHOOSE(sample.pdf > 0.0f, power_heuristic(sample.pdf, pdf), (real)(1.0f)), light);
#endif
    const Rays shadow = {vertex->origin, sample.segment, (real)(0.0f), sample.t_max};
    *rays = shadow;
    const mask above = leads_away(vertex, &sample.direction);
#if STRATEGY == 2
    return above & NOT(sample.pdf > 0.0f) & usable(light) & bright(light);
#else
    return above & usable(light) & bright(light);
#endif
}
#endif

/// The next rays of paths, and what they do to their states; false where the path ends. `width`: of the beams at the
/// vertices.
INLINE mask scatter_paths(const Vertex* vertex, const PathSettings* settings, const Sampler* sampler, whole dimension,
                          real choice, real width, Paths* paths, Rays* rays) {
    Vector wi, value, direction;
    real pdf, u, v;
    sample_square(sampler, dimension + SCATTER_DIMENSION, &u, &v);
    sample_bsdf(&vertex->bsdf, &vertex->wo, choice, u, v, &wi);
    evaluate_bsdf(&vertex->bsdf, &vertex->wo, &wi, &value, &pdf);
    out_of_frame(vertex, &wi, &direction);
    normalise3(&direction);
    scale3(1.0f / pdf, &value);
    multiply3(&paths->throughput, &value, &paths->throughput);
    const real largest = larger(larger(paths->throughput.x, paths->throughput.y), paths->throughput.z);
    mask goes_on = (pdf > 0.0f) & leads_away(vertex, &direction) & (largest > 0.0f) & usable(&paths->throughput);
    paths->bounces += 1;
    const mask at_risk = goes_on & (paths->bounces >= ROULETTE_BOUNCE) & (largest < 1.0f);
    if (ANY(at_risk)) {
        // A multiple of the spacing of samples, so that it is the probability to survive; and not so small that few
        // carry much.
        const real survival = larger(ceil(largest * 0x1p24f) * 0x1p-24f, (real)(0x1p-4f));
        sample_square(sampler, dimension + ROULETTE_DIMENSION, &u, &v);
        goes_on &= NOT(at_risk & (u >= survival));
        scale3(CHOOSE(at_risk, 1.0f / survival, (real)(1.0f)), &paths->throughput);
    }
    paths->pdf = pdf;
#if TEXTURES
    // One of so many samples stands for this solid angle; a radian at most.
    paths->width = width;
    paths->spread = larger(paths->spread, smaller(1.0f / sqrt((float)settings->samples * pdf), (real)(1.0f)));
#else
    (void)width;
    (void)settings;
#endif
    const Rays next = {vertex->origin, direction, (real)(0.0f), (real)(INFINITY)};
    *rays = next;
    return goes_on;
}

#endif
