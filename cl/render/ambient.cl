// SPDX-License-Identifier: MIT
// The simplified model of light of dissertation 3.7.7, a bounce at a time: at each surface of a path
//
//     L = albedo (ambient occlusion + direct shadow + L')
//
// with the Lambert reflection of one punctual light, of an ambient light that depends on the normal alone, and of what the path's
// next surface sends, all opaque. The ray to that surface, drawn by the cosine, also finds the occlusion: 1 - e^-t, t being its length
// in units of a distance, so that a ray which meets nothing is not occluded. (The dissertation's listing takes the occlusion of the
// ray before, and adds the ambient light once more where the ray meets nothing; its formula, followed here, does not.)
// Macros: render/scene_arrays.h, render/texture.h when TEXTURES is 1, render/environment.h, render/sampler.h, and
//
// LIGHTS      1: there are punctual lights.
// GROUP_SIZE  work-items per work-group.
//
// compile: MATERIALS=0 NORMALS=0 TANGENTS=0 UV_SETS=0 COLORS=0 TEXTURES=0 ENVIRONMENT=0 LIGHTS=0 SAMPLER=2
// compile: MATERIALS=1 NORMALS=1 TANGENTS=0 UV_SETS=0 COLORS=1 TEXTURES=0 ENVIRONMENT=1 LIGHTS=1 SAMPLER=0
// compile: MATERIALS=1 NORMALS=1 TANGENTS=1 UV_SETS=2 COLORS=1 TEXTURES=1 ENVIRONMENT=2 LIGHTS=1 SAMPLER=1 FILTER=2
#define ALPHA 0
#define EMISSION 0
#define SPECULAR 0
#define STRATEGY 1
#define UNIFORM_HEMISPHERE 0
#include "render/path.h"

#ifndef GROUP_SIZE
#error "define GROUP_SIZE"
#endif

// Dimensions of the sampler for each bounce.
#define AMBIENT_DIMENSIONS 2u

/// Radiance of the ambient light for a normal: irradiance over pi, from spherical harmonics up to the second degree, 9 times
/// R, G, B (Ramamoorthi and Hanrahan 2001), their constants multiplied in.
inline float3 ambient_light(global const float* coefficients, float3 n) {
    const float basis[9] = {1.0f,      n.y,       n.z,       n.x, n.x * n.y, n.y * n.z, 3.0f * n.z * n.z - 1.0f,
                            n.x * n.z, n.x * n.x - n.y * n.y};
    float3 sum = (float3)(0.0f);
    for (uint k = 0; k < 9; ++k) sum += basis[k] * vload3(k, coefficients);
    return fmax(sum, 0.0f); // the series swings below zero beside a small bright light
}

/// A ray from the vertex by the cosine. Below the surface, where a bent normal may send it, it is mirrored.
inline Ray cosine_ray(const Vertex* vertex, const Sampler* sampler, uint dimension) {
    float3 direction = normalize_any(out_of_frame(vertex, sample_lambert(sample_square(sampler, dimension))));
    const float3 normal = vertex->point.surface.normal;
    direction -= normal * (2.0f * fmin(dot(direction, normal), 0.0f));
    Ray ray;
    vstore3(vertex->origin, 0, ray.origin);
    ray.t_min = 0.0f;
    vstore3(direction, 0, ray.direction);
    ray.t_max = INFINITY;
    return ray;
}

inline void null_ray(global Ray* ray) { vstore3((float3)(0.0f), 0, ray->direction); }

/// The vertex where `ray` met a surface; false for a triangle without area. `first`: seen by the camera.
inline bool vertex_at(const SceneArrays* scene, global const CameraRecord* camera, Ray ray, Hit hit, uint samples, bool first,
                      Vertex* vertex) {
    const float3 direction = vload3(0, ray.direction);
    Beam beam;
#if TEXTURES
    // A diffuse ray stands for one of so many parts of the hemisphere.
    if (first)
        pixel_beam(camera, direction, hit.t, 1.0f / sqrt((float)samples), &beam);
    else
        cone_beam(direction, hit.t * fmin(sqrt(M_PI_F / (float)samples), 1.0f), &beam);
#else
    beam.x = beam.y = (float3)(0.0f);
    (void)camera;
    (void)samples;
    (void)first;
#endif
    shading_point(scene, ray, hit, beam, &vertex->point);
    make_vertex(direction, vertex);
    return dot(vertex->point.surface.normal, vertex->point.surface.normal) > 0.0f;
}

#if LIGHTS
/// A shadow ray towards a punctual light chosen by power, and what arrives along it when it is free; else a null ray.
inline float3 punctual_light(global const LightRecord* lights, global const float* distribution, uint count,
                             const Vertex* vertex, float choice, global Ray* shadow_ray) {
    // Triangles that emit come behind, and have the rest of the distribution.
    const float all = distribution[count];
    choice *= all;
    float probability;
    const uint index = choose(distribution, count, &choice, &probability);
    LightSample sample;
    sample_punctual(lights + index, vertex->origin, probability / all, &sample);
    const float cosine = dot(sample.direction, vertex->point.normal);
    const bool lit = cosine > 0.0f && dot(sample.direction, vertex->point.surface.normal) > 0.0f && usable(sample.value);
    if (!lit) {
        null_ray(shadow_ray);
        return (float3)(0.0f);
    }
    vstore3(vertex->origin, 0, shadow_ray->origin);
    shadow_ray->t_min = 0.0f;
    vstore3(sample.segment, 0, shadow_ray->direction);
    shadow_ray->t_max = sample.t_max;
    return sample.value * (cosine * M_1_PI_F);
}
#endif

/// Bounce number `bounce` of the paths of the pixels from `first_pixel` on, whose rays met `hits`. `throughputs` (3 floats per
/// path, not read for the first bounce) are multiplied by the albedo, and are zero where a path ends. pending (6 floats) gets what
/// the light, if shadow_rays[i] is free, and the ambient light, if it is not occluded, add; next_rays[i] is the ray that finds the
/// occlusion and the next surface. At the first bounce direct gets what is seen as it is, indirect and ambient 0. `next_rays` may
/// be `rays`. A work-item takes `length` consecutive paths of the `count`. No barrier: work-items share nothing.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) void
ambient_bounce(SCENE_PARAMETERS, global const LightRecord* lights, global const float* light_distribution, uint light_count,
               global const EnvironmentRecord* environment, global const float* environment_texels,
               global const float* environment_rows, global const float* environment_columns, global const float* coefficients,
               global const CameraRecord* camera, ulong seed, uint sample, uint samples, uint first_pixel, uint bounce,
               global const Ray* rays, global const Hit* hits, uint count, uint length, global float* throughputs,
               global Ray* next_rays, global Ray* shadow_rays, global float* pending, global float* direct,
               global float* indirect, global float* ambient) {
    const SceneArrays scene = SCENE_ARRAYS;
#if ENVIRONMENT
    const EnvironmentArrays around = {environment,
#if ENVIRONMENT == 2
                                      environment_texels, environment_rows, environment_columns
#endif
    };
#endif
    const ulong begin = (ulong)get_global_id(0) * length;
    const ulong end = min(begin + length, (ulong)count);
    for (ulong i = begin; i < end; ++i) {
        const Ray ray = rays[i];
        const Hit hit = hits[i];
        float3 throughput = bounce == 0 ? (float3)(1.0f) : vload3(i, throughputs);
        float3 seen = (float3)(0.0f), light = seen, around_light = seen;
        bool reflects = hit.primitive != BOXWOOD_NONE && (throughput.x > 0.0f || throughput.y > 0.0f || throughput.z > 0.0f);
        Vertex vertex;
        if (reflects) {
            reflects = vertex_at(&scene, camera, ray, hit, samples, bounce == 0, &vertex);
            const bool unlit = (vertex.point.flags & BOXWOOD_UNLIT) != 0;
            if (unlit)
                seen = throughput * vertex.point.base_color;
            else if (bounce == 0)
                seen = vertex.point.emission;
            reflects = reflects && !unlit;
        }
#if ENVIRONMENT
        if (bounce == 0 && hit.primitive == BOXWOOD_NONE)
            seen = environment_radiance(&around, normalize_any(vload3(0, ray.direction)));
#endif
        throughput = reflects ? throughput * vertex.point.base_color : (float3)(0.0f);
        null_ray(shadow_rays + i);
        null_ray(next_rays + i);
        if (reflects) {
            const Sampler sampler = {random_key(seed, (ulong)first_pixel + i), sample, samples};
            const uint dimension = AMBIENT_DIMENSIONS * bounce;
#if LIGHTS
            light = throughput * punctual_light(lights, light_distribution, light_count, &vertex,
                                                sample_square(&sampler, dimension + 1).x, shadow_rays + i);
#endif
            around_light = throughput * ambient_light(coefficients, vertex.point.normal) * vertex.point.occlusion;
            next_rays[i] = cosine_ray(&vertex, &sampler, dimension);
        }
        vstore3(throughput, i, throughputs);
        vstore3(light, 2 * i, pending);
        vstore3(around_light, 2 * i + 1, pending);
        if (bounce == 0) {
            vstore3(seen, i, direct);
            vstore3((float3)(0.0f), i, indirect);
            vstore3((float3)(0.0f), i, ambient);
        } else {
            vstore3(vload3(i, indirect) + seen, i, indirect);
        }
    }
}

/// Adds what is pending: the light where blocked[i] is 0, the ambient light by the share that the next hit does not occlude. The
/// first bounce adds to direct and ambient and sets ao, the others add to indirect. Without LIGHTS `blocked` may be null.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) void
ambient_gather(global const uint* blocked, global const Hit* next_hits, global const float* pending, float distance, uint bounce,
               uint count, uint length, global float* direct, global float* indirect, global float* ambient, global float* ao) {
    const ulong begin = (ulong)get_global_id(0) * length;
    const ulong end = min(begin + length, (ulong)count);
    for (ulong i = begin; i < end; ++i) {
        const float open = -expm1(-next_hits[i].t / distance);
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
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) void
occlusion_rays(SCENE_PARAMETERS, global const CameraRecord* camera, ulong seed, uint sample, uint samples, uint first_pixel,
               global const Ray* rays, global const Hit* hits, uint count, uint length, global Ray* next_rays) {
    const SceneArrays scene = SCENE_ARRAYS;
    const ulong begin = (ulong)get_global_id(0) * length;
    const ulong end = min(begin + length, (ulong)count);
    for (ulong i = begin; i < end; ++i) {
        null_ray(next_rays + i);
        Vertex vertex;
        if (hits[i].primitive == BOXWOOD_NONE) continue;
        if (!vertex_at(&scene, camera, rays[i], hits[i], samples, true, &vertex)) continue;
        const Sampler sampler = {random_key(seed, (ulong)first_pixel + i), sample, samples};
        next_rays[i] = cosine_ray(&vertex, &sampler, 0);
    }
}

/// ao[i], and light[3 * i] and the two behind it, = the share that is not occluded.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) void
occlusion_light(global const Hit* next_hits, float distance, uint count, uint length, global float* light, global float* ao) {
    const ulong begin = (ulong)get_global_id(0) * length;
    const ulong end = min(begin + length, (ulong)count);
    for (ulong i = begin; i < end; ++i) {
        ao[i] = -expm1(-next_hits[i].t / distance);
        vstore3((float3)(ao[i]), i, light);
    }
}
