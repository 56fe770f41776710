// SPDX-License-Identifier: MIT
// Shading of a queue of rays and their hits: each path gathers light, asks for a shadow ray, and goes on or ends. Macros:
// render/path.h.
//
// GROUP_SIZE  work-items per work-group.
// compile: MATERIALS=0 NORMALS=0 TANGENTS=0 UV_SETS=0 COLORS=0 TEXTURES=0 ALPHA=0 SPECULAR=0 UNIFORM_HEMISPHERE=0 EMISSION=0 LIGHTS=0 ENVIRONMENT=0 STRATEGY=0 SAMPLER=2
// compile: MATERIALS=1 NORMALS=1 TANGENTS=0 UV_SETS=0 COLORS=0 TEXTURES=0 ALPHA=0 SPECULAR=1 UNIFORM_HEMISPHERE=0 EMISSION=0 LIGHTS=0 ENVIRONMENT=1 STRATEGY=0 SAMPLER=2
// compile: MATERIALS=1 NORMALS=0 TANGENTS=0 UV_SETS=0 COLORS=0 TEXTURES=0 ALPHA=0 SPECULAR=0 UNIFORM_HEMISPHERE=1 EMISSION=1 LIGHTS=1 ENVIRONMENT=0 STRATEGY=0 SAMPLER=1
// compile: MATERIALS=1 NORMALS=1 TANGENTS=1 UV_SETS=2 COLORS=1 TEXTURES=1 ALPHA=1 SPECULAR=1 UNIFORM_HEMISPHERE=0 EMISSION=1 LIGHTS=1 ENVIRONMENT=2 STRATEGY=0 SAMPLER=2 FILTER=2
// compile: MATERIALS=1 NORMALS=1 TANGENTS=1 UV_SETS=1 COLORS=0 TEXTURES=1 ALPHA=0 SPECULAR=1 UNIFORM_HEMISPHERE=0 EMISSION=1 LIGHTS=1 ENVIRONMENT=2 STRATEGY=1 SAMPLER=0 FILTER=1
// compile: MATERIALS=1 NORMALS=0 TANGENTS=0 UV_SETS=0 COLORS=0 TEXTURES=0 ALPHA=1 SPECULAR=1 UNIFORM_HEMISPHERE=0 EMISSION=1 LIGHTS=1 ENVIRONMENT=1 STRATEGY=2 SAMPLER=2
// compile: MATERIALS=0 NORMALS=0 TANGENTS=0 UV_SETS=0 COLORS=0 TEXTURES=0 ALPHA=0 SPECULAR=0 UNIFORM_HEMISPHERE=0 EMISSION=0 LIGHTS=1 ENVIRONMENT=0 STRATEGY=2 SAMPLER=2
#include "render/path.h"
#include "render/path_sum.h"

#ifndef GROUP_SIZE
#error "define GROUP_SIZE"
#endif

/// What a path does with its hit, beside going on.
typedef struct Gathered {
    float3 light;       ///< Radiance along the ray, times the throughput.
    float3 shadow;      ///< What the shadow ray stands for, times the throughput.
    PathRay shadow_ray;
    bool has_shadow;
} Gathered;

/// Follows one path at its hit. Returns whether it goes on, with `path` and `ray` as they then are.
INLINE bool follow(const PathWorld* world, const PathSettings* settings, global const CameraRecord* camera, Hit hit,
                   Path* path, PathRay* ray, Gathered* gathered) {
    const uint bounces = path->counts & 0xffffu, layers = path->counts >> 16;
    const float3 direction = ray->direction, throughput = path->throughput;
    gathered->light = (float3)(0.0f);
    gathered->has_shadow = false;
    if (hit.primitive == BOXWOOD_NONE) {
        gathered->light = throughput * sky_light(world, direction, bounces == 0, path->pdf);
        return false;
    }
    if (bounces >= settings->depth && !may_shine(&world->scene, hit)) return false;
    const Sampler sampler = {random_key(settings->seed, (ulong)settings->first_pixel + path->pixel), settings->sample,
                             settings->samples};
    Beam beam;
    const float width = fma(path->spread, hit.t, path->width);
#if TEXTURES
    if (bounces == 0)
        pixel_beam(camera, direction, hit.t, 1.0f / sqrt((float)settings->samples), &beam);
    else
        cone_beam(direction, width, &beam);
#else
    beam.x = beam.y = (float3)(0.0f);
    (void)camera;
#endif
    Vertex vertex;
    find_shading_point(&world->scene, direction, hit, beam, &vertex.point);
#if ALPHA
    const float alpha = vertex.point.alpha;
    if (alpha < 1.0f && sample_square(&sampler, ALPHA_DIMENSION + layers).x >= alpha) {
        ray->t_min = hit.t;
        path->counts += 0x10000u;
        return layers < BOXWOOD_MOST_LAYERS;
    }
#else
    (void)layers;
#endif
    gathered->light = throughput * surface_light(world, &vertex.point, direction, hit, bounces == 0, path->pdf);
    // A triangle without area has no normal.
    const bool solid = dot(vertex.point.surface.normal, vertex.point.surface.normal) > 0.0f;
    if ((vertex.point.flags & BOXWOOD_UNLIT) || bounces >= settings->depth || !solid) return false;

    make_vertex(direction, &vertex);
    const uint dimension = bounces * BOUNCE_DIMENSIONS;
    const float2 choice = sample_square(&sampler, dimension + CHOICE_DIMENSION);
#if NEXT_EVENT
    gathered->has_shadow = next_event(world, &vertex, choice.x, sample_square(&sampler, dimension + LIGHT_DIMENSION),
                                      &gathered->shadow_ray, &gathered->shadow);
    gathered->shadow *= throughput;
#endif
    return scatter_path(&vertex, settings, &sampler, dimension, choice.y, width, path, ray);
}

INLINE void load_ray(global const Ray* from, PathRay* ray) {
    ray->origin = vload3(0, from->origin);
    ray->t_min = from->t_min;
    ray->direction = vload3(0, from->direction);
    ray->t_max = from->t_max;
}

INLINE void store_ray(const PathRay* ray, global Ray* to) {
    vstore3(ray->origin, 0, to->origin);
    to->t_min = ray->t_min;
    vstore3(ray->direction, 0, to->direction);
    to->t_max = ray->t_max;
}

INLINE void load_path(global const PathState* from, Path* path) {
    path->throughput = vload3(0, from->throughput);
    path->pdf = from->pdf;
    path->pixel = from->pixel;
    path->counts = from->counts;
    path->width = from->width;
    path->spread = from->spread;
}

INLINE void store_path(const Path* path, global PathState* to) {
    vstore3(path->throughput, 0, to->throughput);
    to->pdf = path->pdf;
    to->pixel = path->pixel;
    to->counts = path->counts;
    to->width = path->width;
    to->spread = path->spread;
}

#if NEXT_EVENT
/// A ray with a zero direction hits nothing.
INLINE void store_shadow(const Gathered* gathered, uint pixel, bool indirect, global Ray* ray, global ShadowLight* light) {
    const bool wanted = gathered->has_shadow && usable(gathered->shadow);
    light->pixel = wanted ? pixel | (indirect ? BOXWOOD_INDIRECT : 0u) : BOXWOOD_NONE;
    if (wanted) {
        store_ray(&gathered->shadow_ray, ray);
        vstore3(gathered->shadow, 0, light->value);
    } else {
        const PathRay none = {(float3)(0.0f), (float3)(0.0f), 0.0f, 0.0f};
        store_ray(&none, ray);
    }
}
#endif

/// Follows the `count` paths of `states`, rays[i] having met hits[i]; with `first`, the paths begin at the camera, pixel i of the
/// batch with rays[i], states and light are not read. A slice is `length` consecutive paths. direct and indirect (3 per pixel)
/// get what the paths gather; shadow_rays[i] and shadow_lights[i] the shadow ray of path i. The paths of a slice that go on are
/// moved to its front, their number is kept[slice], and kept[slices] = 0. `next_rays` may be `rays`; a path has one pixel and a
/// pixel one path. No barrier: work-items share nothing.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) void shade_paths(
    SCENE_PARAMETERS, global const LightRecord* lights, global const float* light_distribution, uint light_count,
    global const EnvironmentRecord* environment, global const float* environment_texels, global const float* environment_rows,
    global const float* environment_columns, global const CameraRecord* camera, ulong seed, uint sample, uint samples,
    uint depth, uint first_pixel, uint first, global const Ray* rays, global const Hit* hits, uint count, uint length,
    uint slices, global PathState* states, global Ray* next_rays, global Ray* shadow_rays, global ShadowLight* shadow_lights,
    global uint* kept, global float* direct, global float* indirect) {
    const uint slice = (uint)get_global_id(0);
    if (slice >= slices) return;
    PathWorld world;
    const SceneArrays scene = SCENE_ARRAYS;
    world.scene = scene;
#if LIGHTS
    const LightArrays light_arrays = {lights, light_distribution, light_count};
    world.lights = light_arrays;
#endif
#if ENVIRONMENT
    const EnvironmentArrays environment_arrays = {
        environment,
#if ENVIRONMENT == 2
        environment_texels, environment_rows, environment_columns
#endif
    };
    world.environment = environment_arrays;
#endif
    const PathSettings settings = {seed, sample, samples, depth, first_pixel};
    const uint begin = slice * length, end = begin + min(length, count - begin);
    uint place = begin;
    for (uint i = begin; i < end; ++i) {
        Path path;
        if (first) {
            const Path fresh = {(float3)(1.0f), 0.0f, i, 0, 0.0f, 0.0f};
            path = fresh;
            vstore3((float3)(0.0f), i, direct);
            vstore3((float3)(0.0f), i, indirect);
        } else {
            load_path(states + i, &path);
        }
        PathRay ray;
        load_ray(rays + i, &ray);
        const uint bounces = path.counts & 0xffffu;
        Gathered gathered;
        const bool goes_on = follow(&world, &settings, camera, hits[i], &path, &ray, &gathered);
        if (usable(gathered.light)) add_light(gathered.light, (bounces <= 1 ? direct : indirect) + 3 * (size_t)path.pixel);
#if NEXT_EVENT
        store_shadow(&gathered, path.pixel, bounces > 0, shadow_rays + i, shadow_lights + i);
#endif
        if (goes_on) {
            store_ray(&ray, next_rays + place);
            store_path(&path, states + place);
            ++place;
        }
    }
    kept[slice] = place - begin;
    if (slice == slices - 1) kept[slices] = 0;
}
