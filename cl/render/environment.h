// SPDX-License-Identifier: MIT
// Light from infinitely far away: its radiance in a direction, and directions drawn by it.
//
// ENVIRONMENT  0: there is none. 1: the same everywhere; drawn uniformly from the hemisphere over a surface. 2: a picture of the
//              sphere; drawn texel by texel by the mass of the interpolated picture, uniformly over a texel's angles, so that
//              there is no radiance without density.
#ifndef BOXWOOD_RENDER_ENVIRONMENT_H
#define BOXWOOD_RENDER_ENVIRONMENT_H
#include "render/search.h"
#include "render/turn.h"
#include "runtime/vector.h"
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
/// from becomes (1 - part) from + part to, part in [0, 1]; not negative where neither is.
INLINE void mix3(real part, const Vector* to, Vector* from) {
    from->x = fma(part, to->x - from->x, from->x);
    from->y = fma(part, to->y - from->y, from->y);
    from->z = fma(part, to->z - from->z, from->z);
}

/// Radiance at a place of the picture, in texels, bilinear between their centres.
INLINE void picture_radiance(const EnvironmentArrays* environment, real x, real y, Vector* radiance) {
    const uint width = environment->record->width;
    const real right_end = (real)((float)width), bottom = (real)((float)environment->record->height - 1.0f);
    const real column = floor(x - 0.5f), row = floor(y - 0.5f);
    const real across = x - 0.5f - column, down = y - 0.5f - row;
    // Columns wrap around, rows end.
    const whole left = TO_WHOLE(CHOOSE(column < 0.0f, right_end - 1.0f, column));
    const whole right = TO_WHOLE(CHOOSE(column + 1.0f < right_end, column + 1.0f, (real)(0.0f)));
    const whole above = TO_WHOLE(GREATER(row, (real)(0.0f))) * width, below = TO_WHOLE(LESSER(row + 1.0f, bottom)) * width;
    uint index[LANES];
    Vector texels[4];
    STORE_LANES(above + left, index);
    load_vectors(environment->texels, 3, index, &texels[0]);
    STORE_LANES(above + right, index);
    load_vectors(environment->texels, 3, index, &texels[1]);
    STORE_LANES(below + left, index);
    load_vectors(environment->texels, 3, index, &texels[2]);
    STORE_LANES(below + right, index);
    load_vectors(environment->texels, 3, index, &texels[3]);
    mix3(across, &texels[1], &texels[0]);
    mix3(across, &texels[3], &texels[2]);
    mix3(down, &texels[2], &texels[0]);
    *radiance = texels[0];
}

/// Density, by solid angle, in a texel that is chosen with `probability`, uniform over its angles. `sine` is that of the angle
/// to the picture's axis, where the density is infinite: it ends at a sine that floats hardly have room for.
INLINE real texel_density(global const EnvironmentRecord* record, real probability, real sine) {
    const float scale = ((float)record->width * (float)record->height) * (0.5f * M_1_PI_F * M_1_PI_F);
    return probability * scale / GREATER(sine, (real)(0x1p-64f));
}
#endif

#if ENVIRONMENT
/// Radiance from a normalised direction, and the density, by solid angle, with which sample_environment draws it. In lanes whose
/// direction is anything else, it is anything.
INLINE void environment_light(const EnvironmentArrays* environment, const Vector* direction, Vector* radiance, real* pdf) {
#if ENVIRONMENT == 1
    (void)direction;
    *pdf = (real)(0.5f * M_1_PI_F);
    spread3(vload3(0, environment->record->radiance), radiance);
#else
    const uint width = environment->record->width, height = environment->record->height;
    const real right = (real)((float)width), bottom = (real)((float)height);
    const real sine = sqrt(direction->x * direction->x + direction->z * direction->z);
    // By arctangents, which lose no digits at the poles. The middle is -z, the right of it +x. NaN ends at the right and below.
    const real turn = atan2pi(direction->x, -direction->z);
    const real x = LESSER((0.5f + 0.5f * turn) * right, right);
    const real y = LESSER(atan2pi(sine, direction->y) * bottom, bottom);
    uint row[LANES], column[LANES];
    STORE_LANES(TO_WHOLE(LESSER(x, right - 1.0f)), column);
    STORE_LANES(TO_WHOLE(LESSER(y, bottom - 1.0f)), row);
    float of_row[LANES], of_column[LANES];
    for (uint lane = 0; lane < LANES; ++lane) {
        const float2 rows = vload2(0, environment->rows + row[lane]);
        const float2 columns = vload2(0, environment->columns + (size_t)row[lane] * (width + 1) + column[lane]);
        of_row[lane] = rows.y - rows.x;
        of_column[lane] = columns.y - columns.x;
    }
    *pdf = texel_density(environment->record, LOAD_LANES(of_row) * LOAD_LANES(of_column), sine);
    picture_radiance(environment, x, y, radiance);
#endif
}

/// Draws a direction by u and v in [0, 1); tells its radiance and its density. `normal` is that of the surface, read for a
/// constant environment.
INLINE void sample_environment(const EnvironmentArrays* environment, const Vector* normal, real u, real v, Vector* direction,
                               Vector* radiance, real* pdf) {
#if ENVIRONMENT == 1
    const real z = 1.0f - 2.0f * v;
    const real radius = sqrt(GREATER(1.0f - z * z, (real)(0.0f)));
    real sine, cosine;
    sincos_turn(u, &sine, &cosine);
    const Vector d = {radius * cosine, radius * sine, z};
    const real sign = CHOOSE(dot3(&d, normal) < 0.0f, (real)(-1.0f), (real)(1.0f));
    *direction = d;
    scale3(sign, direction);
    *pdf = (real)(0.5f * M_1_PI_F);
    spread3(vload3(0, environment->record->radiance), radiance);
#else
    const uint width = environment->record->width, height = environment->record->height;
    uint zero[LANES], row[LANES], column[LANES];
    for (uint lane = 0; lane < LANES; ++lane) zero[lane] = 0;
    real of_row, of_column;
    choose(environment->rows, height, zero, &v, row, &of_row);
    choose(environment->columns, width, row, &u, column, &of_column);
    (void)normal;
    const real x = TO_REAL(LOAD_LANES(column)) + u, y = TO_REAL(LOAD_LANES(row)) + v;
    real sine, cosine, sine_across, cosine_across;
    sincos_turn(0.5f * (y / (float)height), &sine, &cosine);
    sincos_turn(x / (float)width, &sine_across, &cosine_across);
    // Half a turn off: the middle of the picture is -z.
    const Vector d = {-(sine * sine_across), cosine, sine * cosine_across};
    *direction = d;
    *pdf = texel_density(environment->record, of_row * of_column, sine);
    picture_radiance(environment, x, y, radiance);
#endif
}
#endif

#endif
