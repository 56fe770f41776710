// SPDX-License-Identifier: MIT
// The simplified model of light of dissertation 3.7.7, a bounce at a time: at each surface of a path
//
//     L = albedo (ambient occlusion + direct shadow + L')
//
// with the Lambert reflection of one punctual light, of an ambient light that depends on the normal alone, and of what
// the path's next surface sends, all opaque. The ray to that surface, drawn by the cosine, also finds the occlusion: 1
// - e^-t, t being its length in units of a distance, so that a ray which meets nothing is not occluded. (The
// dissertation's listing takes the occlusion of the ray before, and adds the ambient light once more where the ray
// meets nothing; its formula, followed here, does not.) Macros: render/scene_arrays.h, render/texture.h when TEXTURES
// is 1, render/environment.h, render/sampler.h, and
//
// LIGHTS      1: there are punctual lights.
// GROUP_SIZE  work-items per work-group.
//
// compile: MATERIALS=0 NORMALS=0 TANGENTS=0 UV_SETS=0 COLORS=0 TEXTURES=0 ENVIRONMENT=0 LIGHTS=0 SAMPLER=2 LANES=16 TRANSFORMS=1
// compile: MATERIALS=1 NORMALS=1 TANGENTS=0 UV_SETS=0 COLORS=1 TEXTURES=0 ENVIRONMENT=1 LIGHTS=1 SAMPLER=0 LANES=1 TRANSFORMS=0
// compile: MATERIALS=1 NORMALS=1 TANGENTS=1 UV_SETS=2 COLORS=1 TEXTURES=1 ENVIRONMENT=2 LIGHTS=1 SAMPLER=1 FILTER=2 WIDE_TEXELS=1 LANES=16 TRANSFORMS=1
#define ALPHA 0
#define EMISSION 0
#define SPECULAR 0
#define STRATEGY 1
#define UNIFORM_HEMISPHERE 0
#include "shared/sample.h"
#include "render/elementary.h"
#include "render/path.h"

#ifndef GROUP_SIZE
#error "define GROUP_SIZE"
#endif

// Dimensions of the sampler for each bounce.
#define AMBIENT_DIMENSIONS 2u

/// Radiance of the ambient light for normals: irradiance over pi, from spherical harmonics up to the second degree, 9
/// times R, G, B (Ramamoorthi and Hanrahan 2001), their constants multiplied in.
INLINE void ambient_light(global const float* coefficients, const Vector* n, Vector* light) {
    const real basis[9] = {(real)(1.0f),
                           n->y,
                           n->z,
                           n->x,
                           n->x * n->y,
                           n->y * n->z,
                           3.0f * n->z * n->z - 1.0f,
                           n->x * n->z,
                           n->x * n->x - n->y * n->y};
    const real zero = 0.0f;
    Vector sum = {zero, zero, zero}, coefficient;
    for (uint k = 0; k < 9; ++k) {
        spread3(vload3(k, coefficients), &coefficient);
        add_scaled3(basis[k], &coefficient, &sum);
    }
    // The series swings below zero beside a small bright light.
    const Vector positive = {larger(sum.x, zero), larger(sum.y, zero), larger(sum.z, zero)};
    *light = positive;
}

/// Rays from vertices by the cosine. Into the surface, where a bent normal may send them, they are mirrored.
INLINE void cosine_rays(const Vertex* vertex, const Sampler* sampler, uint dimension, Rays* rays) {
    real u, v;
    Vector wi, direction;
    sample_square(sampler, (whole)(dimension), &u, &v);
    sample_lambert(u, v, &wi);
    out_of_frame(vertex, &wi, &direction);
    normalise3(&direction);
    const Vector* normal = &vertex->point.surface.normal;
    const real mirrored = -2.0f * dot3(&direction, normal);
    add_scaled3(CHOOSE(leads_away(vertex, &direction), (real)(0.0f), mirrored), normal, &direction);
    const Rays r = {vertex->origin, direction, (real)(0.0f), (real)(INFINITY)};
    *rays = r;
}

/// The vertices where rays along `direction`, `first` those of the camera, met surfaces. Returns where those have an
/// area.
INLINE mask find_vertices(const SceneArrays* scene, global const CameraRecord* camera, const Vector* direction,
                          const Hits* hits, uint samples, bool first, Vertex* vertex) {
    Beam beam;
#if TEXTURES
    // A diffuse ray stands for one of so many parts of the hemisphere.
    if (first)
        pixel_beam(camera, direction, hits->t, 1.0f / sqrt((float)samples), &beam);
    else
        cone_beam(direction, hits->t * fmin(sqrt(M_PI_F / (float)samples), 1.0f), &beam);
#else
    (void)camera;
    (void)samples;
    (void)first;
#endif
    find_shading_point(scene, direction, hits, &beam, &vertex->point);
    make_vertex(direction, vertex);
    return is_solid(&vertex->point.surface);
}

#if LIGHTS
/// Shadow rays towards punctual lights, and what arrives along them when they are free. Returns where there are any.
INLINE mask find_light(const LightArrays* lights, const Vertex* vertex, real choice, Rays* rays, Vector* light) {
    real probability;
    uint index[LANES];
    LightProbabilities probabilities;
    light_probabilities(&lights->tree, 0.0f, &vertex->origin, &probabilities);
    choose_any_light(&lights->tree, &probabilities, &vertex->origin, &choice, index, &probability);
    LightSample sample;
    sample_punctual(lights->records, index, &vertex->origin, probability, &sample);
    const real cosine = dot3(&sample.direction, &vertex->point.normal);
    const Rays shadow = {vertex->origin, sample.segment, (real)(0.0f), sample.t_max};
    *rays = shadow;
    *light = sample.value;
    scale3(cosine * M_1_PI_F, light);
    return (cosine > 0.0f) & leads_away(vertex, &sample.direction) & usable(&sample.value);
}
#endif

/// One bounce of a path in each lane.
typedef struct Bounce {
    Vector throughput;
    Vector seen;   ///< What is shown as it is.
    Vector light;  ///< What the light adds if the shadow ray is free,
    Vector around; ///< and the ambient light if it is not occluded.
    Rays shadow_rays, next_rays;
} Bounce;

/// What all paths of a launch share.
typedef struct AmbientSettings {
    global const CameraRecord* camera;
    global const float* coefficients;
    SampleSettings sample;
    uint bounce;
} AmbientSettings;

/// The bounces of paths, `index` within the batch, whose rays along `direction` met `hits`; `throughput` is given.
INLINE void find_bounce(const SceneArrays* scene, const LightArrays* lights, const AmbientSettings* settings,
                        const uint* index, const Vector* direction, const Hits* hits, Bounce* result) {
    const Vector dark = {(real)(0.0f), (real)(0.0f), (real)(0.0f)};
    result->seen = result->light = result->around = dark;
    null_rays(&result->shadow_rays);
    null_rays(&result->next_rays);
    mask reflects = hits->some & bright(&result->throughput), lit = (mask)(0);
    if (ANY(reflects)) {
        Vertex vertex;
        const mask met = reflects;
        reflects &= find_vertices(scene, settings->camera, direction, hits, settings->sample.samples,
                                  settings->bounce == 0, &vertex) &
                    NOT(vertex.point.unlit);
        multiply3(&result->throughput, &vertex.point.base_color, &result->throughput);
        if (settings->bounce == 0) choose3(met, &vertex.point.emission, &result->seen);
        choose3(met & vertex.point.unlit, &result->throughput, &result->seen);
        const Sampler sampler = {
            random_key(settings->sample.seed, TO_WIDE(LOAD_LANES(index)) + settings->sample.first_pixel),
            settings->sample.sample, settings->sample.samples};
        const uint dimension = AMBIENT_DIMENSIONS * settings->bounce;
#if LIGHTS
        real choice, unused;
        sample_square(&sampler, (whole)(dimension + 1), &choice, &unused);
        lit = reflects & find_light(lights, &vertex, choice, &result->shadow_rays, &result->light);
        multiply3(&result->throughput, &result->light, &result->light);
#else
        (void)lights;
#endif
        ambient_light(settings->coefficients, &vertex.point.normal, &result->around);
        multiply3(&result->throughput, &result->around, &result->around);
        scale3(vertex.point.occlusion, &result->around);
        cosine_rays(&vertex, &sampler, dimension, &result->next_rays);
    }
    choose3(NOT(lit), &dark, &result->light);
    choose3(NOT(reflects), &dark, &result->around);
    choose3(NOT(reflects), &dark, &result->throughput);
    clear_rays(NOT(lit), &result->shadow_rays);
    clear_rays(NOT(reflects), &result->next_rays);
}

/// Bounce number `bounce` of the paths of the pixels from `first_pixel` on, whose rays met `hits`. `throughputs` (3
/// floats per path, not read for the first bounce) are multiplied by the albedo, and are zero where a path ends.
/// pending (6 floats) gets what the light, if shadow_rays[i] is free, and the ambient light, if it is not occluded,
/// add; next_rays[i] is the ray that finds the occlusion and the next surface. At the first bounce direct gets what is
/// seen as it is, indirect and ambient 0. `next_rays` may be `rays`. A work-item takes `length` consecutive paths of
/// the `count`. No barrier: work-items share nothing.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void ambient_bounce(SCENE_PARAMETERS, LIGHT_PARAMETERS, ENVIRONMENT_PARAMETERS, global const float* coefficients,
                    global const CameraRecord* camera, SampleSettings sample, uint bounce, global const Ray* rays,
                    global const Hit* hits, uint count, uint length, global float* throughputs, global Ray* next_rays,
                    global Ray* shadow_rays, global float* pending, global float* direct, global float* indirect,
                    global float* ambient) {
    const SceneArrays scene = SCENE_ARRAYS;
#if LIGHTS
    const LightArrays light_arrays = LIGHT_ARRAYS;
#else
    const LightArrays light_arrays = {lights, {light_nodes, 0, BOXWOOD_NONE, BOXWOOD_NONE}};
#endif
#if ENVIRONMENT
    const EnvironmentArrays around = ENVIRONMENT_ARRAYS;
#endif
    const AmbientSettings settings = {camera, coefficients, sample, bounce};
    const ulong begin = (ulong)get_global_id(0) * length;
    const ulong end = min(begin + length, (ulong)count);
    for (ulong i = begin; i < end; i += LANES) {
        const uint used = (uint)min((ulong)LANES, end - i);
        uint index[LANES];
        lane_indices((uint)i, used, index);
        Rays view;
        Hits met;
        Bounce result;
        load_rays(rays, index, &view);
        load_hits(hits, index, &met);
        if (bounce == 0)
            spread3((float3)(1.0f), &result.throughput);
        else
            load_vectors(throughputs, 3, index, &result.throughput);
        find_bounce(&scene, &light_arrays, &settings, index, &view.direction, &met, &result);
        store_vectors(&result.throughput, throughputs, 3, index, used);
        store_vectors(&result.light, pending, 6, index, used);
        store_vectors(&result.around, pending + 3, 6, index, used);
        store_rays(&result.next_rays, next_rays, index, used);
#if LIGHTS
        store_rays(&result.shadow_rays, shadow_rays, index, used);
#endif
        if (bounce == 0) {
            const Vector dark = {(real)(0.0f), (real)(0.0f), (real)(0.0f)};
#if ENVIRONMENT
            Vector sky;
            real pdf;
            environment_light(&around, &view.direction, &sky, &pdf);
            choose3(NOT(met.some), &sky, &result.seen);
#endif
            store_vectors(&result.seen, direct, 3, index, used);
            store_vectors(&dark, indirect, 3, index, used);
            store_vectors(&dark, ambient, 3, index, used);
        } else {
            Vector sum;
            load_vectors(indirect, 3, index, &sum);
            add3(&result.seen, &sum, &sum);
            store_vectors(&sum, indirect, 3, index, used);
        }
    }
}

/// Adds what is pending: the light where blocked[i] is 0, the ambient light by the fraction that the next hit does not
/// occlude. The first bounce adds to direct and ambient and sets ao, the others add to indirect. Without LIGHTS
/// `blocked` may be null.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void ambient_gather(global const uint* blocked, global const Hit* next_hits, global const float* pending,
                    float distance, uint bounce, uint count, uint length, global float* direct, global float* indirect,
                    global float* ambient, global float* ao) {
    const ulong begin = (ulong)get_global_id(0) * length;
    const ulong end = min(begin + length, (ulong)count);
    for (ulong i = begin; i < end; ++i) {
        const float open = absorbed_fraction(next_hits[i].t / distance);
#if LIGHTS
        const float free = blocked[i] ? 0.0f : 1.0f;
        const float3 light = free * vload3(2 * i, pending);
#else
        const float3 light = (float3)(0.0f);
#endif
        const float3 around = open * vload3(2 * i + 1, pending);
        if (bounce == 0) {
            vstore3(vload3(i, direct) + light, i, direct);
            vstore3(around, i, ambient);
            ao[i] = open;
        } else {
            vstore3(vload3(i, indirect) + (light + around), i, indirect);
        }
    }
}

/// next_rays[i] finds the occlusion where rays[i] met a surface, as above; a null ray for a miss.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void occlusion_rays(SCENE_PARAMETERS, global const CameraRecord* camera, SampleSettings sample, global const Ray* rays,
                    global const Hit* hits, uint count, uint length, global Ray* next_rays) {
    const SceneArrays scene = SCENE_ARRAYS;
    const ulong begin = (ulong)get_global_id(0) * length;
    const ulong end = min(begin + length, (ulong)count);
    for (ulong i = begin; i < end; i += LANES) {
        const uint used = (uint)min((ulong)LANES, end - i);
        uint index[LANES];
        lane_indices((uint)i, used, index);
        Rays view, next;
        Hits met;
        load_rays(rays, index, &view);
        load_hits(hits, index, &met);
        mask reflects = met.some;
        null_rays(&next);
        if (ANY(reflects)) {
            Vertex vertex;
            reflects &= find_vertices(&scene, camera, &view.direction, &met, sample.samples, true, &vertex);
            const Sampler sampler = {random_key(sample.seed, TO_WIDE(LOAD_LANES(index)) + sample.first_pixel),
                                     sample.sample, sample.samples};
            cosine_rays(&vertex, &sampler, 0, &next);
        }
        clear_rays(NOT(reflects), &next);
        store_rays(&next, next_rays, index, used);
    }
}

/// ao[i], and light[3 * i] and the two behind it, = the fraction that is not occluded.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void occlusion_light(global const Hit* next_hits, float distance, uint count, uint length, global float* light,
                     global float* ao) {
    const ulong begin = (ulong)get_global_id(0) * length;
    const ulong end = min(begin + length, (ulong)count);
    for (ulong i = begin; i < end; ++i) {
        ao[i] = absorbed_fraction(next_hits[i].t / distance);
        vstore3((float3)(ao[i]), i, light);
    }
}
