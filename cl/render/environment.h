// SPDX-License-Identifier: MIT
// Light from infinitely far away: its radiance in a direction, and directions drawn by it.
//
// ENVIRONMENT  0: there is none. 1: the same everywhere; drawn uniformly from the hemisphere over a surface. 2: a picture of the
//              sphere; drawn texel by texel by the mass of the interpolated picture, uniformly within a texel, so that there is
//              no radiance without density.
#ifndef BOXWOOD_RENDER_ENVIRONMENT_H
#define BOXWOOD_RENDER_ENVIRONMENT_H
#include "render/search.h"
#include "runtime/numerics.h"
#include "shared/environment.h"

#if ENVIRONMENT < 0 || ENVIRONMENT > 2
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
/// Where on the picture a normalised direction is, in texels: [0, width] and [0, height].
inline float2 environment_place(global const EnvironmentRecord* record, float3 direction) {
    // By arctangents, which lose no digits at the poles. The middle is -z, the right of it +x.
    const float across = 0.5f + 0.5f * atan2pi(direction.x, -direction.z);
    const float down = atan2pi(sqrt(direction.x * direction.x + direction.z * direction.z), direction.y);
    return (float2)(across * (float)record->width, down * (float)record->height);
}

inline float3 environment_texel(const EnvironmentArrays* environment, int column, int row) {
    const int width = (int)environment->record->width, height = (int)environment->record->height;
    const int x = column < 0 ? column + width : column >= width ? column - width : column;
    const int y = clamp(row, 0, height - 1);
    return vload3((ulong)y * (uint)width + (uint)x, environment->texels);
}
#endif

#if ENVIRONMENT
/// Radiance from a normalised direction.
inline float3 environment_radiance(const EnvironmentArrays* environment, float3 direction) {
#if ENVIRONMENT == 1
    (void)direction;
    return vload3(0, environment->record->radiance);
#else
    const float2 place = environment_place(environment->record, direction) - 0.5f;
    const float2 corner = floor(place), t = place - corner;
    const int x = (int)corner.x, y = (int)corner.y;
    const float3 above = mix(environment_texel(environment, x, y), environment_texel(environment, x + 1, y), t.x);
    const float3 below = mix(environment_texel(environment, x, y + 1), environment_texel(environment, x + 1, y + 1), t.x);
    return mix(above, below, t.y);
#endif
}

#if ENVIRONMENT == 2
/// 1 - cos of the angle from +y to the top of a row: without cancellation near that pole.
inline float row_height(global const EnvironmentRecord* record, uint row) {
    const float half_sine = sinpi(0.5f * (float)row / (float)record->height);
    return 2.0f * half_sine * half_sine;
}

/// Density, by solid angle, within a texel that is chosen with `probability`.
inline float texel_density(global const EnvironmentRecord* record, uint row, float probability) {
    const float height = row_height(record, row + 1) - row_height(record, row);
    return probability * (float)record->width / (2.0f * M_PI_F * height);
}
#endif

/// Density, by solid angle, with which sample_environment draws a normalised direction.
inline float environment_pdf(const EnvironmentArrays* environment, float3 direction) {
#if ENVIRONMENT == 1
    (void)environment;
    (void)direction;
    return 0.5f * M_1_PI_F;
#else
    const uint width = environment->record->width, height = environment->record->height;
    const float2 place = environment_place(environment->record, direction);
    const uint row = min((uint)place.y, height - 1u), column = min((uint)place.x, width - 1u);
    global const float* columns = environment->columns + (ulong)row * (width + 1) + column;
    const float probability = (environment->rows[row + 1] - environment->rows[row]) * (columns[1] - columns[0]);
    return texel_density(environment->record, row, probability);
#endif
}

/// Draws a direction by u in [0, 1)^2; returns its density. `normal` is that of the surface, read for a constant environment.
inline float sample_environment(const EnvironmentArrays* environment, float3 normal, float2 u, float3* direction) {
#if ENVIRONMENT == 1
    (void)environment;
    const float z = 1.0f - 2.0f * u.y;
    const float radius = sqrt(clamp(1.0f - z * z, 0.0f, 1.0f));
    const float3 d = (float3)(radius * cospi(2.0f * u.x), radius * sinpi(2.0f * u.x), z);
    *direction = dot(d, normal) < 0.0f ? -d : d;
    return 0.5f * M_1_PI_F;
#else
    const uint width = environment->record->width, height = environment->record->height;
    float of_row, of_column;
    float across = u.x, down = u.y;
    const uint row = choose(environment->rows, height, &down, &of_row);
    const uint column = choose(environment->columns + (ulong)row * (width + 1), width, &across, &of_column);
    (void)normal;
    const float top = row_height(environment->record, row), bottom = row_height(environment->record, row + 1);
    const float t = top + down * (bottom - top);
    const float radius = sqrt(clamp(t * (2.0f - t), 0.0f, 1.0f));
    const float turn = 2.0f * ((float)column + across) / (float)width - 1.0f;
    *direction = (float3)(radius * sinpi(turn), 1.0f - t, -radius * cospi(turn));
    return texel_density(environment->record, row, of_row * of_column);
#endif
}
#endif

#endif
