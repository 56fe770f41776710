// SPDX-License-Identifier: MIT
// Shadow rays through surfaces that transmit light: each hit absorbs its fraction, and the ray goes on behind it.
// Macros: render/scene_arrays.h, render/texture.h when TEXTURES is 1, and
//
// LANES       1
// GROUP_SIZE  work-items per work-group.
// compile: MATERIALS=1 NORMALS=0 TANGENTS=0 UV_SETS=0 COLORS=0 TEXTURES=0 LANES=1
// compile: MATERIALS=1 NORMALS=1 TANGENTS=1 UV_SETS=2 COLORS=1 TEXTURES=1 FILTER=2 WIDE_TEXELS=1 LANES=1
#include "render/path_sum.h"
#include "render/random.h"
#include "render/spot.h"
#include "shared/ray.h"
#include "shared/sample.h"

#if !defined(GROUP_SIZE) || LANES != 1
#error "define GROUP_SIZE and LANES (1)"
#endif

/// The fraction of light that the surface at a hit lets pass; textures at their finest.
INLINE float passed_fraction(const SceneArrays* scene, Hit hit) {
    Spot spot;
    spot_of(scene, hit.instance, hit.primitive, hit.u, hit.v, &spot);
    global const MaterialRecord* material = scene->materials + spot.material;
    if (!(material->flags & (BOXWOOD_ALPHA_MASK | BOXWOOD_ALPHA_BLEND))) return 0.0f;
    return 1.0f - stopped_fraction(material, color_at(scene, &spot).w);
}

/// All of the light or none: `fraction` of it on average.
INLINE float russian_roulette(float fraction, const SampleSettings* settings, uint pixel, uint round, uint layer) {
    const ulong key =
        random_bits(random_bits(random_key(settings->seed, settings->first_pixel + pixel), settings->sample), round);
    return (float)(random_bits(key, layer) >> 40) * 0x1p-24f < fraction ? 1.0f : 0.0f;
}

/// Of the `count` shadow rays, hits[i] being what ray i met, those that met nothing add their light to their pixel, of
/// which there is at most one each, and those whose light passes their surface are moved to the front of their slice to
/// go on behind it. `layer` is how many surfaces they have passed, `round` what else tells rays of one sample of a
/// pixel apart. A slice is `length` consecutive ones; kept[slice] is how many go on, and kept[slices] = 0. No barrier:
/// work-items share nothing.
kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
void pass_shadows(SCENE_PARAMETERS, SampleSettings settings, uint round, uint layer, global const Hit* hits, uint count,
                  uint length, uint slices, global Ray* rays, global ShadowLight* lights, global uint* kept,
                  global float* direct, global float* indirect) {
    const uint slice = (uint)get_global_id(0);
    if (slice >= slices) return;
    const SceneArrays scene = SCENE_ARRAYS;
    const uint begin = slice * length, end = begin + min(length, count - begin);
    uint place = begin;
    for (uint i = begin; i < end; ++i) {
        ShadowLight light = lights[i];
        if (light.pixel == BOXWOOD_NONE) continue;
        const Hit hit = hits[i];
        if (hit.primitive == BOXWOOD_NONE) {
            add_shadow_light(lights + i, direct, indirect);
            continue;
        }
        float passed = passed_fraction(&scene, hit);
        if (layer >= BOXWOOD_SURE_LAYERS)
            passed = russian_roulette(passed, &settings, light.pixel & ~BOXWOOD_INDIRECT, round, layer);
        if (!(passed > 0.0f)) continue;
        vstore3(vload3(0, light.value) * passed, 0, light.value);
        Ray ray = rays[i];
        ray.t_min = hit.t;
        rays[place] = ray;
        lights[place] = light;
        ++place;
    }
    kept[slice] = place - begin;
    if (slice == slices - 1) kept[slices] = 0;
}
