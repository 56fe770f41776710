// SPDX-License-Identifier: MIT
// Light from the lights of a scene: one chosen by power, a point on it, and with what density. Macros: render/shading_point.h.
//
// ALPHA  1: some surface lets light pass
#ifndef BOXWOOD_RENDER_LIGHTS_H
#define BOXWOOD_RENDER_LIGHTS_H
#include "render/search.h"
#include "render/shading_point.h"
#include "shared/light.h"

#ifndef ALPHA
#error "define ALPHA (0 or 1)"
#endif

/// The lights of an Appearance.
typedef struct LightArrays {
    global const LightRecord* records;
    global const float* distribution;
    uint count; ///< > 0
} LightArrays;

/// Light on a point from one place.
typedef struct LightSample {
    float3 segment;   ///< From the point to what must be free of obstacles.
    float t_max;      ///< Where that ends, in lengths of the segment.
    float3 direction; ///< The same, normalised.
    float3 value;     ///< Radiance over density: times f cos it is what the point reflects.
    float pdf;        ///< Density by solid angle; 0 for a light without extent.
} LightSample;

// The largest float below 1: the end of a segment is left out.
#define BEFORE_END 0x1.fffffep-1f

/// The light without extent that `light` is, chosen with `probability`; value 0 where it does not reach.
INLINE void sample_punctual(global const LightRecord* light, float3 origin, float probability, LightSample* sample) {
    const float3 axis = vload3(0, light->direction), intensity = vload3(0, light->intensity);
    sample->pdf = 0.0f;
    if (light->kind == BOXWOOD_DIRECTIONAL_LIGHT) {
        sample->segment = sample->direction = -axis;
        sample->t_max = INFINITY;
        sample->value = intensity / probability;
        return;
    }
    // As KHR_lights_punctual has it: an inverse square with a window that closes at the range, and a cone's edge.
    sample->segment = vload3(0, light->position) - origin;
    sample->t_max = BEFORE_END;
    sample->direction = normalize_any(sample->segment);
    const float square = dot(sample->segment, sample->segment);
    const float part = square / (light->range * light->range), window = clamp(1.0f - part * part, 0.0f, 1.0f);
    float strength = window / (square * probability);
    if (light->kind == BOXWOOD_SPOT_LIGHT) {
        const float cosine = -dot(sample->direction, axis);
        const float edge = clamp(cosine * light->cone_scale + light->cone_offset, 0.0f, 1.0f);
        strength *= edge * edge;
    }
    sample->value = square > 0.0f ? intensity * strength : (float3)(0.0f);
}

/// Radiance of a triangle at a place on it, towards its front.
INLINE float3 light_radiance(const SceneArrays* scene, global const LightRecord* light, Hit place) {
    float3 radiance = vload3(0, light->intensity);
#if TEXTURES || ALPHA
    Place at;
    place_of(scene, place, &at);
#if UV_SETS
    at.weight_x = at.weight_y = (float2)(0.0f);
#endif
#if TEXTURES
    radiance *= texture_at(scene, &at, scene->materials[at.material].textures + BOXWOOD_EMISSION).xyz;
#endif
#if ALPHA
    radiance *= stopped_share(scene->materials + at.material, color_at(scene, &at).w);
#endif
#else
    (void)scene;
    (void)place;
#endif
    return radiance;
}

#if EMISSION
/// The triangle that `light` is, at a uniform point of it. The segment ends clear of it.
INLINE void sample_triangle(const SceneArrays* scene, global const LightRecord* light, float3 origin, float2 u,
                            float probability, LightSample* sample) {
    const float root = sqrt(u.x);
    const Hit place = {1.0f, root * (1.0f - u.y), root * u.y, light->primitive, light->instance};
    const float3 along = place.u * vload3(0, light->edges[0]) + place.v * vload3(0, light->edges[1]);
    const float3 point = vload3(0, light->position) + along;
    const float3 front = vload3(0, light->direction);
    const bool behind = dot(front, origin - point) < 0.0f;
    const float3 normal = behind ? -front : front;
    sample->segment = point + light->clearance * normal - origin;
    sample->t_max = BEFORE_END;
    sample->direction = normalize_any(sample->segment);
    const float cosine = -dot(sample->direction, normal);
    sample->value = (float3)(0.0f);
    sample->pdf = 0.0f;
    if (!(cosine > 0.0f) || (behind && !light->two_sided)) return;
    sample->pdf = probability * (dot(sample->segment, sample->segment) / (cosine * light->area));
    if (sample->pdf > 0.0f) sample->value = light_radiance(scene, light, place) / sample->pdf;
}

/// Density, by solid angle, with which sample_light draws the place that a ray met after `distance` at an angle of `cosine`.
/// O(log lights): triangles are ordered by instance and primitive, after the lights without extent.
INLINE float triangle_pdf(const LightArrays* lights, Hit hit, float distance, float cosine) {
    const ulong wanted = (ulong)hit.instance << 32 | hit.primitive;
    uint low = 0, high = lights->count;
    while (low < high) {
        const uint middle = low + (high - low) / 2;
        global const LightRecord* light = lights->records + middle;
        const bool before = light->kind != BOXWOOD_TRIANGLE_LIGHT || ((ulong)light->instance << 32 | light->primitive) < wanted;
        low = before ? middle + 1 : low;
        high = before ? high : middle;
    }
    if (low == lights->count) return 0.0f;
    global const LightRecord* light = lights->records + low;
    if (light->instance != hit.instance || light->primitive != hit.primitive) return 0.0f;
    const float probability = lights->distribution[low + 1] - lights->distribution[low];
    return cosine > 0.0f ? probability * (distance * distance / (cosine * light->area)) : 0.0f;
}
#endif

/// Light on `origin`; `choice` in [0, 1) takes the light, which all together have `share` of the samples, u the point on it.
INLINE void sample_light(const SceneArrays* scene, const LightArrays* lights, float3 origin, float choice, float2 u,
                         float share, LightSample* sample) {
    float probability;
    const uint index = choose(lights->distribution, lights->count, &choice, &probability);
    global const LightRecord* light = lights->records + index;
    probability *= share;
#if EMISSION
    if (light->kind == BOXWOOD_TRIANGLE_LIGHT) {
        sample_triangle(scene, light, origin, u, probability, sample);
        return;
    }
#else
    (void)scene;
    (void)u;
#endif
    sample_punctual(light, origin, probability, sample);
}

#endif
