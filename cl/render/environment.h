// SPDX-License-Identifier: MIT
// Light from infinitely far away: its radiance in a direction, and directions drawn by it.
//
// ENVIRONMENT  0: there is none. 1: the same everywhere; drawn uniformly from the hemisphere over a surface. 2: a picture of the
//              sphere; drawn texel by texel by the mass of the interpolated picture, uniformly over a texel's angles, so that
//              there is no radiance without density.
#ifndef BOXWOOD_RENDER_ENVIRONMENT_H
#define BOXWOOD_RENDER_ENVIRONMENT_H
#include "render/search.h"
#include "runtime/inline.h"
#include "runtime/numerics.h"
#include "shared/environment.h"

#if !defined(ENVIRONMENT) || ENVIRONMENT < 0 || ENVIRONMENT > 2
#error "define ENVIRONMENT (0 none, 1 constant, 2 picture)"
#endif

#if ENVIRONMENT
typedef struct EnvironmentArrays {
    global const EnvironmentRecord* record;
#if ENVIRONMENT == 2
    global const float* texels;  ///< 3 per texel, rows from +y to -y.
    global const float* rows;    ///< height + 1: distribution over the rows.
    global const float* columns; ///< height times width + 1: distributions over the texels of a row.
#endif
} EnvironmentArrays;
#endif

#if ENVIRONMENT == 2
INLINE float3 environment_texel(const EnvironmentArrays* environment, int column, int row) {
    const int width = (int)environment->record->width, height = (int)environment->record->height;
    const int x = column < 0 ? column + width : column >= width ? column - width : column;
    const int y = clamp(row, 0, height - 1);
    return vload3((ulong)y * (uint)width + (uint)x, environment->texels);
}

/// Radiance at a place of the picture, bilinear between the centres of texels.
INLINE float3 picture_radiance(const EnvironmentArrays* environment, float2 place) {
    const float2 corner = floor(place - 0.5f), t = place - 0.5f - corner;
    const int x = (int)corner.x, y = (int)corner.y;
    const float3 above = mix(environment_texel(environment, x, y), environment_texel(environment, x + 1, y), t.x);
    const float3 below = mix(environment_texel(environment, x, y + 1), environment_texel(environment, x + 1, y + 1), t.x);
    return mix(above, below, t.y);
}

/// Density, by solid angle, in a texel that is chosen with `probability`, uniform over its angles. `sine` is that of the angle
/// to the picture's axis, at which the density is infinite.
INLINE float texel_density(global const EnvironmentRecord* record, float probability, float sine) {
    return probability * ((float)record->width * (float)record->height) * (0.5f * M_1_PI_F * M_1_PI_F) / sine;
}
#endif

#if ENVIRONMENT
/// Radiance from a normalised direction, and the density, by solid angle, with which sample_environment draws it.
INLINE float3 environment_light(const EnvironmentArrays* environment, float3 direction, float* pdf) {
#if ENVIRONMENT == 1
    (void)direction;
    *pdf = 0.5f * M_1_PI_F;
    return vload3(0, environment->record->radiance);
#else
    const uint width = environment->record->width, height = environment->record->height;
    const float sine = sqrt(direction.x * direction.x + direction.z * direction.z);
    // By arctangents, which lose no digits at the poles. The middle is -z, the right of it +x.
    const float2 place = (float2)((0.5f + 0.5f * atan2pi(direction.x, -direction.z)) * (float)width,
                                  atan2pi(sine, direction.y) * (float)height);
    const uint row = min((uint)place.y, height - 1u), column = min((uint)place.x, width - 1u);
    global const float* columns = environment->columns + (ulong)row * (width + 1) + column;
    const float probability = (environment->rows[row + 1] - environment->rows[row]) * (columns[1] - columns[0]);
    *pdf = texel_density(environment->record, probability, sine);
    return picture_radiance(environment, place);
#endif
}

INLINE float3 environment_radiance(const EnvironmentArrays* environment, float3 direction) {
    float pdf;
    return environment_light(environment, direction, &pdf);
}

/// Draws a direction by u in [0, 1)^2; tells its radiance and its density. `normal` is that of the surface, read for a constant
/// environment.
INLINE float3 sample_environment(const EnvironmentArrays* environment, float3 normal, float2 u, float3* direction,
                                 float* pdf) {
#if ENVIRONMENT == 1
    const float z = 1.0f - 2.0f * u.y;
    const float radius = sqrt(clamp(1.0f - z * z, 0.0f, 1.0f));
    const float3 d = (float3)(radius * cospi(2.0f * u.x), radius * sinpi(2.0f * u.x), z);
    *direction = dot(d, normal) < 0.0f ? -d : d;
    *pdf = 0.5f * M_1_PI_F;
    return vload3(0, environment->record->radiance);
#else
    const uint width = environment->record->width, height = environment->record->height;
    float of_row, of_column;
    float across = u.x, down = u.y;
    const uint row = choose(environment->rows, height, &down, &of_row);
    const uint column = choose(environment->columns + (ulong)row * (width + 1), width, &across, &of_column);
    (void)normal;
    const float2 place = (float2)((float)column + across, (float)row + down);
    const float polar = place.y / (float)height, turn = 2.0f * place.x / (float)width - 1.0f;
    const float sine = sinpi(polar);
    *direction = (float3)(sine * sinpi(turn), cospi(polar), -sine * cospi(turn));
    *pdf = texel_density(environment->record, of_row * of_column, sine);
    return picture_radiance(environment, place);
#endif
}
#endif

#endif
