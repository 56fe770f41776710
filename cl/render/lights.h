// SPDX-License-Identifier: MIT
// Light from the lights of a scene: one chosen for the place, a point on it, and with what density. Nothing depends on
// how large the scene is. Macros: render/shading_point.h, runtime/real.h.
//
// ALPHA     1: some surface lets light pass
// EMISSION  1: some triangles are lights
#ifndef BOXWOOD_RENDER_LIGHTS_H
#define BOXWOOD_RENDER_LIGHTS_H
#include "render/light_tree.h"
#include "render/shading_point.h"
#include "runtime/vector.h"
#include "shared/light.h"

#if !defined(ALPHA) || !defined(EMISSION)
#error "define ALPHA and EMISSION (0 or 1)"
#endif

/// The lights of an Appearance.
typedef struct LightArrays {
    global const LightRecord* records;
    LightTree tree;
} LightArrays;

// The parameters of a kernel with lights, and the LightArrays of them.
#define LIGHT_PARAMETERS global const LightRecord *lights, global const LightNode *light_nodes, uint light_count
#define LIGHT_ARRAYS \
    { lights, light_tree_of(light_nodes, light_count) }

/// Light on a point from one place.
typedef struct LightSample {
    Vector segment;   ///< From the point to what must be free of obstacles.
    real t_max;       ///< Where that ends, in lengths of the segment.
    Vector direction; ///< The same, normalised.
    Vector value;     ///< Radiance over density: times f cos it is what the point reflects.
    real pdf;         ///< Density by solid angle; 0 for a light without extent.
} LightSample;

/// A LightRecord in each lane.
typedef struct Light {
    Vector position, axis, intensity, edges[2];
    mask kind, two_sided;
    real range, inverse_size, cone_scale, cone_edge, clearance;
} Light;

#define LIGHT_FLOATS 24

INLINE void load_lights(global const LightRecord* records, const uint* index, Light* light) {
    global const float* base = (global const float*)records;
    real v[LIGHT_FLOATS];
    load_rows8(base, LIGHT_FLOATS, index, v);
    load_rows8(base + 8, LIGHT_FLOATS, index, v + 8);
    load_rows8(base + 16, LIGHT_FLOATS, index, v + 16);
    const Light loaded = {{v[0], v[1], v[2]},
                          {v[4], v[5], v[6]},
                          {v[8], v[9], v[10]},
                          {{v[12], v[13], v[14]}, {v[15], v[16], v[17]}},
                          AS_INT(v[3]),
                          AS_INT(v[22]) != 0,
                          v[7],
                          v[11],
                          v[18],
                          v[19],
                          v[23]};
    *light = loaded;
}

/// The part of a spot's intensity that goes along `direction`, which is `v` normalised. As KHR_lights_punctual has it,
/// but by 1 - cosine = sine^2 / (1 + cosine), `square` being that of v.
INLINE real spot_edge(const Light* light, const Vector* v, real square, const Vector* direction) {
    Vector sine;
    exact_cross3(&light->axis, v, &sine);
    scale3(light->cone_scale, &sine);
    const real cosine = -dot3(direction, &light->axis);
    const real off = dot3(&sine, &sine) / (square * (1.0f + cosine));
    const real edge = LESSER((1.0f - off) * light->cone_edge, (real)(1.0f));
    return CHOOSE((cosine > 0.0f) & (edge > 0.0f), edge * edge, (real)(0.0f));
}

/// The lights without extent, chosen with `probability`; value 0 where one does not reach.
INLINE void punctual_light(const Light* light, const Vector* origin, real probability, LightSample* sample) {
    // As KHR_lights_punctual has it: an inverse square with a window that closes at the range, and a cone's edge.
    Vector v;
    subtract3(&light->position, origin, &v);
    sample->segment = v;
    const real power = power_below(largest3(&v)), inverse = inverse_power(power);
    scale3(inverse, &v);
    const real square = dot3(&v, &v), length = sqrt(square);
    sample->direction = v;
    scale3(CHOOSE(square > 0.0f, 1.0f / length, (real)(0.0f)), &sample->direction);
    const real reach = power * (length / light->range), part = reach * reach, window = 1.0f - part * part;
    real strength = CHOOSE((square > 0.0f) & (window > 0.0f), window / (square * probability), (real)(0.0f));
    const mask spot = light->kind == (int)BOXWOOD_SPOT_LIGHT;
    if (ANY(spot)) {
        const real edge = spot_edge(light, &v, square, &sample->direction);
        strength = CHOOSE(spot, strength * edge, strength);
    }
    sample->value = light->intensity;
    scale3(inverse, &sample->value);
    scale3(inverse, &sample->value);
    scale3(strength, &sample->value);
    sample->t_max = (real)(BEFORE_ONE);
    sample->pdf = (real)(0.0f);

    const mask distant = light->kind == (int)BOXWOOD_DIRECTIONAL_LIGHT;
    if (ANY(distant)) {
        const Vector towards = {-light->axis.x, -light->axis.y, -light->axis.z};
        choose3(distant, &towards, &sample->segment);
        choose3(distant, &towards, &sample->direction);
        Vector value = light->intensity;
        scale3(1.0f / probability, &value);
        choose3(distant, &value, &sample->value);
        sample->t_max = CHOOSE(distant, (real)(INFINITY), sample->t_max);
    }
}

/// The lights without extent that `index` names; of others anything.
INLINE void sample_punctual(global const LightRecord* records, const uint* index, const Vector* origin,
                            real probability, LightSample* sample) {
    Light light;
    load_lights(records, index, &light);
    punctual_light(&light, origin, probability, sample);
}

#if EMISSION
#if TEXTURES || ALPHA
/// What textures and alpha make of the radiance of a triangle at a place on it. The finest level of a texture: as if
/// the lamp were seen from near, whatever the beam that meets it.
inline float3 lamp_texture_at(const SceneArrays* scene, uint instance, uint primitive, float u, float v) {
    float3 factor = (float3)(1.0f);
    Spot spot;
    spot_of(scene, instance, primitive, u, v, &spot);
    global const MaterialRecord* material = scene->materials + spot.material;
#if TEXTURES
    factor *= texture_at(scene, &spot, material->textures + BOXWOOD_EMISSION).xyz;
#endif
#if ALPHA
    factor *= stopped_fraction(material, color_at(scene, &spot).w);
#endif
    return factor;
}

/// The same in the lanes that are wanted, for the lights that `index` names; `value` is multiplied by it.
INLINE void shade_lamps(const SceneArrays* scene, global const LightRecord* records, const uint* index, mask wanted,
                        real u, real v, Vector* value) {
    int wants[LANES];
    float us[LANES], vs[LANES], red[LANES], green[LANES], blue[LANES];
    STORE_LANES(wanted, wants);
    STORE_LANES(u, us);
    STORE_LANES(v, vs);
    for (uint lane = 0; lane < LANES; ++lane) {
        float3 factor = (float3)(1.0f);
        global const LightRecord* record = records + index[lane];
        if (wants[lane]) factor = lamp_texture_at(scene, record->instance, record->primitive, us[lane], vs[lane]);
        red[lane] = factor.x;
        green[lane] = factor.y;
        blue[lane] = factor.z;
    }
    const Vector factors = {LOAD_LANES(red), LOAD_LANES(green), LOAD_LANES(blue)};
    multiply3(value, &factors, value);
}
#endif

/// The triangles at a uniform point of each; `sample` stays as it is where not `wanted`. The segment ends clear of the
/// triangle.
INLINE void sample_triangle(const SceneArrays* scene, global const LightRecord* records, const uint* index,
                            const Light* light, mask wanted, const Vector* origin, real u, real v, real probability,
                            LightSample* sample) {
    const real root = sqrt(u), along1 = root * (1.0f - v), along2 = root * v;
    Vector point = {along1 * light->edges[0].x + along2 * light->edges[1].x,
                    along1 * light->edges[0].y + along2 * light->edges[1].y,
                    along1 * light->edges[0].z + along2 * light->edges[1].z};
    add3(&light->position, &point, &point);
    Vector normal = light->axis, segment;
    subtract3(&point, origin, &segment);
    const mask behind = dot3(&normal, &segment) > 0.0f;
    scale3(CHOOSE(behind, (real)(-1.0f), (real)(1.0f)), &normal);
    add_scaled3(light->clearance, &normal, &point);
    subtract3(&point, origin, &segment);

    const real power = power_below(largest3(&segment));
    Vector direction = segment;
    scale3(inverse_power(power), &direction);
    const real square = dot3(&direction, &direction);
    scale3(CHOOSE(square > 0.0f, 1.0f / sqrt(square), (real)(0.0f)), &direction);
    const real cosine = -dot3(&direction, &normal), far = power * light->inverse_size;
    const real density = probability * (square / cosine) * far * far;
    const mask lit =
        wanted & (cosine > 0.0f) & (NOT(behind) | light->two_sided) & (density > 0.0f) & (density < INFINITY);
    const real pdf = CHOOSE(lit, density, (real)(0.0f)), weight = CHOOSE(lit, 1.0f / density, (real)(0.0f));
    Vector value = light->intensity;
    scale3(weight, &value);
#if TEXTURES || ALPHA
    shade_lamps(scene, records, index, lit, along1, along2, &value);
#endif
    choose3(wanted, &segment, &sample->segment);
    choose3(wanted, &direction, &sample->direction);
    choose3(wanted, &value, &sample->value);
    sample->pdf = CHOOSE(wanted, pdf, sample->pdf);
    sample->t_max = CHOOSE(wanted, (real)(BEFORE_ONE), sample->t_max);
}

/// Density, by solid angle, with which sample_light draws, for `origin`, the place that a ray from there met after
/// `distance` at an angle of `cosine`, but for the probability of lights that are near; 0 where a lane's triangle is no
/// light. O(log lights): triangles are ordered by instance and primitive, after the lights without extent, which have
/// no instance.
INLINE real triangle_pdf(const LightArrays* lights, const Vector* origin, const uint* instance, const uint* primitive,
                         real distance, real cosine) {
    uint low[LANES];
    for (uint lane = 0; lane < LANES; ++lane) low[lane] = 0;
    for (uint left = lights->tree.inner + 1; left > 1; left -= left >> 1) {
        const uint step = left >> 1;
        for (uint lane = 0; lane < LANES; ++lane) {
            // BOXWOOD_NONE + 1 is 0: before all others.
            global const LightRecord* light = lights->records + low[lane] + step;
            const ulong key = (ulong)(light->instance + 1u) << 32 | light->primitive;
            const ulong wanted = (ulong)(instance[lane] + 1u) << 32 | primitive[lane];
            low[lane] += key <= wanted ? step : 0u;
        }
    }
    int is_light[LANES];
    float sizes[LANES];
    for (uint lane = 0; lane < LANES; ++lane) {
        global const LightRecord* light = lights->records + low[lane];
        const bool found = light->kind == BOXWOOD_TRIANGLE_LIGHT && light->instance == instance[lane] &&
                           light->primitive == primitive[lane];
        is_light[lane] = found ? -1 : 0;
        sizes[lane] = light->inverse_size;
        low[lane] = found ? low[lane] : lights->tree.inner; // the last one, a triangle if there is any
    }
    const mask found = LOAD_LANES(is_light) != 0;
    if (!ANY(found)) return (real)(0.0f);
    const real far = distance * LOAD_LANES(sizes);
    const real density = near_probability(&lights->tree, low, origin) * (far * far / cosine);
    // As where it is drawn: what has no finite density is left to the surface.
    return CHOOSE(found & (cosine > 0.0f) & (density > 0.0f) & (density < INFINITY), density, (real)(0.0f));
}
#endif

/// Chooses among all lights by u in [0, probabilities->distant + probabilities->near), which becomes what is left of
/// it, uniform in [0, 1); also the light's probability among all samples. Any u gives a light.
INLINE void choose_any_light(const LightTree* tree, const LightProbabilities* probabilities, const Vector* origin,
                             real* u, uint* index, real* probability) {
    mask distant = *u < probabilities->distant;
    if (tree->distant == BOXWOOD_NONE || tree->near == BOXWOOD_NONE)
        distant = (mask)(tree->near == BOXWOOD_NONE ? -1 : 0);
    const real of_kind = CHOOSE(distant, probabilities->distant, probabilities->near);
    *u = smaller(larger(CHOOSE(distant, *u, *u - probabilities->distant) / of_kind, (real)(0.0f)), (real)(BEFORE_ONE));
    uint root[LANES];
    STORE_LANES(CHOOSE(distant, (whole)(tree->distant), (whole)(tree->near)), root);
    choose_light(tree, root, origin, u, index, probability);
    *probability *= of_kind;
}

/// Light on `origin`: u, see choose_any_light, and v in [0, 1), a point of one pattern, take the light and the place on
/// it, so that the lights share the pattern's evenness; `low_bits` in [0, 1) is what u loses where lights are many.
INLINE void sample_light(const SceneArrays* scene, const LightArrays* lights, const LightProbabilities* probabilities,
                         const Vector* origin, real u, real v, real low_bits, LightSample* sample) {
    uint index[LANES];
    real probability;
    choose_any_light(&lights->tree, probabilities, origin, &u, index, &probability);
    u = smaller(fma(low_bits, smaller(0x1p-24f / probability, (real)(1.0f)), u), (real)(BEFORE_ONE));
    Light light;
    load_lights(lights->records, index, &light);
#if EMISSION
    const mask triangle = light.kind == (int)BOXWOOD_TRIANGLE_LIGHT;
    const real none = 0.0f;
    const LightSample dark = {{none, none, none}, none, {none, none, none}, {none, none, none}, none};
    *sample = dark;
    if (ANY(NOT(triangle))) punctual_light(&light, origin, probability, sample);
    if (ANY(triangle)) {
        sample_triangle(scene, lights->records, index, &light, triangle, origin, u, v, probability, sample);
    }
#else
    (void)scene;
    (void)u;
    (void)v;
    punctual_light(&light, origin, probability, sample);
#endif
}

#endif
