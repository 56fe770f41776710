// SPDX-License-Identifier: MIT
// Shading of a queue of rays and their hits: each path gathers light, asks for a shadow ray, and goes on or ends.
// Macros: render/path.h, and
//
// GROUP_SIZE  work-items per work-group.
// compile: MATERIALS=0 NORMALS=0 TANGENTS=0 UV_SETS=0 COLORS=0 TEXTURES=0 ALPHA=0 SPECULAR=0 UNIFORM_HEMISPHERE=0 EMISSION=0 LIGHTS=0 ENVIRONMENT=0 STRATEGY=0 SAMPLER=2 LANES=16 TRANSFORMS=1
// compile: MATERIALS=1 NORMALS=1 TANGENTS=0 UV_SETS=0 COLORS=0 TEXTURES=0 ALPHA=0 SPECULAR=1 UNIFORM_HEMISPHERE=0 EMISSION=0 LIGHTS=0 ENVIRONMENT=1 STRATEGY=0 SAMPLER=2 LANES=1 TRANSFORMS=0
// compile: MATERIALS=1 NORMALS=0 TANGENTS=0 UV_SETS=0 COLORS=0 TEXTURES=0 ALPHA=0 SPECULAR=0 UNIFORM_HEMISPHERE=1 EMISSION=1 LIGHTS=1 ENVIRONMENT=0 STRATEGY=0 SAMPLER=1 LANES=16 TRANSFORMS=1
// compile: MATERIALS=1 NORMALS=1 TANGENTS=1 UV_SETS=2 COLORS=1 TEXTURES=1 ALPHA=1 SPECULAR=1 UNIFORM_HEMISPHERE=0 EMISSION=1 LIGHTS=1 ENVIRONMENT=2 STRATEGY=0 SAMPLER=2 FILTER=2 WIDE_TEXELS=1 LANES=1 TRANSFORMS=1
// compile: MATERIALS=1 NORMALS=1 TANGENTS=1 UV_SETS=1 COLORS=0 TEXTURES=1 ALPHA=0 SPECULAR=1 UNIFORM_HEMISPHERE=0 EMISSION=1 LIGHTS=1 ENVIRONMENT=2 STRATEGY=1 SAMPLER=0 FILTER=1 WIDE_TEXELS=0 LANES=8 TRANSFORMS=0
// compile: MATERIALS=1 NORMALS=0 TANGENTS=0 UV_SETS=0 COLORS=0 TEXTURES=0 ALPHA=1 SPECULAR=1 UNIFORM_HEMISPHERE=0 EMISSION=1 LIGHTS=1 ENVIRONMENT=1 STRATEGY=2 SAMPLER=2 LANES=1 TRANSFORMS=1
// compile: MATERIALS=0 NORMALS=0 TANGENTS=0 UV_SETS=0 COLORS=0 TEXTURES=0 ALPHA=0 SPECULAR=0 UNIFORM_HEMISPHERE=0 EMISSION=0 LIGHTS=1 ENVIRONMENT=0 STRATEGY=2 SAMPLER=2 LANES=16 TRANSFORMS=1
#include "render/path.h"
#include "render/path_sum.h"
#include "runtime/products.h"

#ifndef GROUP_SIZE
#error "define GROUP_SIZE"
#endif

/// What paths do with their hits, beside going on.
typedef struct Gathered {
    Vector light;  ///< Radiance along the ray, times the throughput.
    Vector shadow; ///< What the shadow ray stands for, times the throughput.
    Rays shadow_rays;
    mask has_shadow;
} Gathered;

// Spread of a cone, for one sample per pixel, up to which what it meets is seen as in a mirror: of roughness 0.13.
#define MIRROR_SPREAD 0x1p-4f

/// The beams where they meet the surfaces; `width` is that of the path's cone there, `spread` what it grows by per
/// distance.
INLINE void find_beam(global const CameraRecord* camera, const SampleSettings* settings, const Vector* direction,
                      real t, mask first, real width, real spread, Beam* beam) {
#if TEXTURES
    cone_beam(direction, width, beam);
    beam->exact_light = NOT(first);
    beam->sharp = first | (spread * sqrt((float)settings->samples) <= MIRROR_SPREAD);
    if (!ANY(first)) return;
    Beam of_pixel;
    pixel_beam(camera, direction, t, 1.0f / sqrt((float)settings->samples), &of_pixel);
    choose3(first, &of_pixel.x, &beam->x);
    choose3(first, &of_pixel.y, &beam->y);
#else
    (void)camera;
    (void)settings;
    (void)direction;
    (void)t;
    (void)first;
    (void)width;
    (void)spread;
    (void)beam;
#endif
}

#if ALPHA
/// Paths that pass a surface because of its alpha go on behind it, each nearer to the end of its ray: they end, however
/// many there are.
INLINE void pass_surfaces(mask passes, const Paths* before, const Rays* rays_before, real t, real alpha, Paths* paths,
                          Rays* rays) {
    choose3(passes, &before->throughput, &paths->throughput);
    paths->pdf = CHOOSE(passes, before->pdf, paths->pdf);
    paths->width = CHOOSE(passes, before->width, paths->width);
    paths->spread = CHOOSE(passes, before->spread, paths->spread);
    paths->bounces = CHOOSE(passes, before->bounces, paths->bounces);
    paths->layers = CHOOSE(passes & (alpha > 0.0f), before->layers + 1, before->layers);
    choose3(passes, &rays_before->origin, &rays->origin);
    choose3(passes, &rays_before->direction, &rays->direction);
    rays->t_min = CHOOSE(passes, t, rays->t_min);
    rays->t_max = CHOOSE(passes, rays_before->t_max, rays->t_max);
}
#endif

/// Follows paths at the surfaces on which the lanes of `met` are. Returns which go on, with `paths` and `rays` as they
/// then are.
INLINE mask leave_surfaces(const PathWorld* world, const SampleSettings* settings, global const CameraRecord* camera,
                           const Hits* hits, mask met, Paths* paths, Rays* rays, Gathered* gathered) {
    const Sampler sampler = {random_key(settings->seed, TO_WIDE(paths->pixel) + settings->first_pixel),
                             settings->sample, settings->samples};
    const Vector direction = rays->direction;
    const mask first = paths->bounces == 0;
    const real width = fma(paths->spread, hits->t, paths->width);
    Beam beam;
    Vertex vertex;
    find_beam(camera, settings, &direction, hits->t, first, width, paths->spread, &beam);
    find_shading_point(&world->scene, &direction, hits, &beam, &vertex.point);
#if ALPHA
    const Paths before = *paths;
    const Rays rays_before = *rays;
    real probability, unused;
    sample_square(&sampler, ALPHA_DIMENSION + paths->layers, &probability, &unused);
    const mask passes = met & (vertex.point.alpha < 1.0f) & (probability >= vertex.point.alpha);
    met &= NOT(passes);
#endif
    Vector light;
    surface_light(world, &vertex.point, rays, hits, first, paths->pdf, &light);
    choose3(met, &light, &gathered->light);

    mask goes_on = met & NOT(vertex.point.unlit) & (paths->bounces < settings->depth) & is_solid(&vertex.point.surface);
    if (ANY(goes_on)) {
        make_vertex(&direction, &vertex);
        const whole dimension = paths->bounces * BOUNCE_DIMENSIONS;
        real low_bits, lobe_choice;
        sample_square(&sampler, dimension + CHOICE_DIMENSION, &low_bits, &lobe_choice);
#if NEXT_EVENT
        real u, v;
        sample_square(&sampler, dimension + LIGHT_DIMENSION, &u, &v);
        gathered->has_shadow =
            goes_on & next_event(world, &vertex, u, v, low_bits, &gathered->shadow_rays, &gathered->shadow);
#endif
        goes_on &= scatter_paths(&vertex, settings, &sampler, dimension, lobe_choice, width, paths, rays);
    }
#if ALPHA
    pass_surfaces(passes, &before, &rays_before, hits->t, vertex.point.alpha, paths, rays);
    goes_on |= passes;
#endif
    return goes_on;
}

/// Follows paths at their hits. Returns which go on, with `paths` and `rays` as they then are.
INLINE mask follow(const PathWorld* world, const SampleSettings* settings, global const CameraRecord* camera,
                   const Hits* hits, Paths* paths, Rays* rays, Gathered* gathered) {
    const Vector dark = {(real)(0.0f), (real)(0.0f), (real)(0.0f)}, throughput = paths->throughput;
    gathered->light = gathered->shadow = dark;
    gathered->has_shadow = (mask)(0);
    null_rays(&gathered->shadow_rays);
    const mask missed = NOT(hits->some);
    if (ANY(missed)) {
        Vector light;
        sky_light(world, rays, paths->bounces == 0, paths->pdf, &light);
        choose3(missed, &light, &gathered->light);
    }
    mask goes_on = (mask)(0), met = hits->some;
    const mask last = paths->bounces >= settings->depth;
    if (ANY(met & last)) met &= NOT(last) | may_shine(&world->scene, hits);
    if (ANY(met)) goes_on = leave_surfaces(world, settings, camera, hits, met, paths, rays, gathered);
    multiply3(&throughput, &gathered->light, &gathered->light);
    multiply3(&throughput, &gathered->shadow, &gathered->shadow);
    gathered->has_shadow &= usable(&gathered->shadow);
    return goes_on;
}

/// Paths at the camera, of the pixels that `pixel` names.
INLINE void begin_paths(global const CameraRecord* camera, uint samples, const uint* pixel, Paths* paths) {
    const real zero = 0.0f, one = 1.0f;
    const Paths fresh = {{one, one, one}, zero, zero, zero, LOAD_LANES(pixel), (whole)(0), (whole)(0)};
    *paths = fresh;
#if TEXTURES
    // The cone of a pixel, for paths that pass its surface or leave it: as wide as the longer side.
    const float3 right = vload3(0, camera->right), up = vload3(0, camera->up);
    const float width = 2.0f * fmax(length_float3(right), length_float3(up)) / sqrt((float)samples);
    if (camera->perspective)
        paths->spread = width;
    else
        paths->width = width;
#else
    (void)camera;
    (void)samples;
#endif
}

/// No light yet for the pixels [first, first + count).
INLINE void clear_light(uint first, uint count, global float* direct, global float* indirect) {
    for (uint i = first; i < first + count; ++i) {
        vstore3((float3)(0.0f), i, direct);
        vstore3((float3)(0.0f), i, indirect);
    }
}

INLINE void load_paths(global const PathState* states, const uint* index, Paths* paths) {
    real row[8];
    load_rows8(states->throughput, 8, index, row);
    const whole counts = AS_WHOLE(row[5]);
    const Paths p = {{row[0], row[1], row[2]}, row[3], row[6], row[7], AS_WHOLE(row[4]), counts & 0xffu, counts >> 8};
    *paths = p;
}

INLINE void store_paths(const Paths* paths, global PathState* states, const uint* index, uint count) {
    real row[8] = {paths->throughput.x, paths->throughput.y,   paths->throughput.z,
                   paths->pdf,          AS_REAL(paths->pixel), AS_REAL(paths->bounces | paths->layers << 8),
                   paths->width,        paths->spread};
    store_rows8(row, states->throughput, 8, index, count);
}

#if NEXT_EVENT
INLINE void store_shadows(Gathered* gathered, const Paths* paths, mask indirect, global Ray* rays,
                          global ShadowLight* lights, const uint* index, uint count) {
    clear_rays(NOT(gathered->has_shadow), &gathered->shadow_rays);
    store_rays(&gathered->shadow_rays, rays, index, count);
    const whole pixel = paths->pixel | CHOOSE(indirect, (whole)(BOXWOOD_INDIRECT), (whole)(0));
    real row[8] = {gathered->shadow.x, gathered->shadow.y, gathered->shadow.z,
                   AS_REAL(CHOOSE(gathered->has_shadow, pixel, (whole)(BOXWOOD_NONE)))};
    store_rows4(row, lights->value, 4, index, count);
}
#endif

/// Adds the light of the first `count` lanes to their pixels, of which there is one each.
INLINE void add_gathered(const Vector* light, const Paths* paths, mask indirect, uint count, global float* direct_sum,
                         global float* indirect_sum) {
    const mask some = usable(light) & bright(light);
    if (!ANY(some)) return;
    float value[3][LANES];
    uint pixel[LANES];
    int wanted[LANES], to_indirect[LANES];
    STORE_LANES(light->x, value[0]);
    STORE_LANES(light->y, value[1]);
    STORE_LANES(light->z, value[2]);
    STORE_LANES(paths->pixel, pixel);
    STORE_LANES(some, wanted);
    STORE_LANES(indirect, to_indirect);
    for (uint lane = 0; lane < count; ++lane) {
        if (!wanted[lane]) continue;
        global float* sum = to_indirect[lane] ? indirect_sum : direct_sum;
        add_light((float3)(value[0][lane], value[1][lane], value[2][lane]), sum + 3 * (size_t)pixel[lane]);
    }
}

/// Where the lanes that go on are kept; the others name the place of the next one, which overwrites them. Returns the
/// place behind all.
INLINE uint keep_lanes(mask goes_on, uint count, uint place, uint* index) {
    int keeps[LANES];
    STORE_LANES(goes_on, keeps);
    for (uint lane = 0; lane < LANES; ++lane) {
        index[lane] = place;
        place += lane < count && keeps[lane];
    }
    return place;
}

/// Follows the `count` paths of `states`, rays[i] having met hits[i]; with `first`, the paths begin at the camera,
/// pixel i of the batch with rays[i], states and light are not read. A slice is `length` consecutive paths. direct and
/// indirect (3 per pixel) get what the paths gather; shadow_rays[i] and shadow_lights[i] the shadow ray of path i. The
/// paths of a slice that go on are moved to its front, their number is kept[slice], and kept[slices] = 0. `next_rays`
/// may be `rays`; a path has one pixel and a pixel one path. No barrier: work-items share nothing.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void shade_paths(SCENE_PARAMETERS, LIGHT_PARAMETERS, ENVIRONMENT_PARAMETERS, global const CameraRecord* camera,
                 SampleSettings settings, uint first, global const Ray* rays, global const Hit* hits, uint count,
                 uint length, uint slices, global PathState* states, global Ray* next_rays, global Ray* shadow_rays,
                 global ShadowLight* shadow_lights, global uint* kept, global float* direct, global float* indirect) {
    const uint slice = (uint)get_global_id(0);
    if (slice >= slices) return;
    PathWorld world;
    const SceneArrays scene = SCENE_ARRAYS;
    world.scene = scene;
#if LIGHTS
    const LightArrays light_arrays = LIGHT_ARRAYS;
    world.lights = light_arrays;
#endif
#if ENVIRONMENT
    const EnvironmentArrays environment_arrays = ENVIRONMENT_ARRAYS;
    world.environment = environment_arrays;
#endif
    const uint begin = slice * length, end = begin + min(length, count - begin);
    uint place = begin;
    for (uint i = begin; i < end; i += LANES) {
        const uint used = min((uint)LANES, end - i);
        uint index[LANES], to[LANES];
        lane_indices(i, used, index);
        Paths paths;
        if (first) {
            begin_paths(camera, settings.samples, index, &paths);
            clear_light(i, used, direct, indirect);
        } else {
            load_paths(states, index, &paths);
        }
        Rays ray_lanes;
        Hits met;
        load_rays(rays, index, &ray_lanes);
        load_hits(hits, index, &met);
        const whole bounces = paths.bounces;
        Gathered gathered;
        const mask goes_on = follow(&world, &settings, camera, &met, &paths, &ray_lanes, &gathered);
        add_gathered(&gathered.light, &paths, bounces > 1, used, direct, indirect);
#if NEXT_EVENT
        store_shadows(&gathered, &paths, bounces > 0, shadow_rays, shadow_lights, index, used);
#endif
        place = keep_lanes(goes_on, used, place, to);
        store_rays(&ray_lanes, next_rays, to, used);
        store_paths(&paths, states, to, used);
    }
    kept[slice] = place - begin;
    if (slice == slices - 1) kept[slices] = 0;
}
