// SPDX-License-Identifier: MIT
// Light from infinitely far away: its radiance in a direction, and directions drawn by it.
//
// ENVIRONMENT  0: there is none. 1: the same everywhere; drawn uniformly from the hemisphere over a surface. 2: a
//              picture of the sphere, bilinear between the centres of texels; drawn by its luminance: a patch between
//              four centres, then a place in it (Pharr, Jakob and Humphreys 2023, A.5), so that there is no radiance
//              without density.
// COMPENSATED  for ENVIRONMENT 2. 1: surfaces draw directions, too, and both are weighted by the balance or power
//              heuristic: drawn by what is above the mean luminance, the even part being left to the surfaces (Karlik
//              et al. 2019). 0: by all of it.
#ifndef BOXWOOD_RENDER_ENVIRONMENT_H
#define BOXWOOD_RENDER_ENVIRONMENT_H
#include "render/search.h"
#include "render/turn.h"
#include "runtime/vector.h"
#include "shared/environment.h"

#if !defined(ENVIRONMENT) || ENVIRONMENT < 0 || ENVIRONMENT > 2
#error "define ENVIRONMENT (0 none, 1 constant, 2 picture)"
#endif

#if ENVIRONMENT == 2 && !defined(COMPENSATED)
#error "define COMPENSATED (0 or 1)"
#endif

#if ENVIRONMENT
typedef struct EnvironmentArrays {
    global const EnvironmentRecord* record;
#if ENVIRONMENT == 2
    global const float* texels;  ///< 3 per texel, rows from +y to -y.
    global const float* rows;    ///< height + 2: distribution over the rows of patches, by COMPENSATED.
    global const float* columns; ///< height + 1 times width + 1: distributions over the patches of a row.
#endif
} EnvironmentArrays;
#endif

// The parameters of a kernel that is lit from infinitely far away, and the EnvironmentArrays of them.
#define ENVIRONMENT_PARAMETERS                                                           \
    global const EnvironmentRecord *environment, global const float *environment_texels, \
        global const float *environment_rows, global const float *environment_columns
#if ENVIRONMENT == 2
#define ENVIRONMENT_ARRAYS \
    { environment, environment_texels, environment_rows, environment_columns }
#else
#define ENVIRONMENT_ARRAYS \
    { environment }
#endif

#if ENVIRONMENT == 2
/// from becomes (1 - part) from + part to, part in [0, 1]; not negative where neither is.
INLINE void mix3(real part, const Vector* to, Vector* from) {
    from->x = fma(part, to->x - from->x, from->x);
    from->y = fma(part, to->y - from->y, from->y);
    from->z = fma(part, to->z - from->z, from->z);
}

/// A patch of the picture, in each lane: the texels whose centres are its corners (those of the first or the last row
/// twice, half a texel being left beyond them), and where it begins and ends, in texels.
typedef struct Patch {
    Vector corners[2][2]; ///< Radiance, by row and column,
    real weights[2][2];   ///< and what places are drawn by.
    real left, top, height;
} Patch;

INLINE real luminance(const Vector* c) { return fma(c->x, 0.2126f, fma(c->y, 0.7152f, c->z * 0.0722f)); }

/// from becomes (1 - part) from + part to, not negative where neither is.
INLINE real mix_weights(real from, real to, real part) { return GREATER(fma(part, to - from, from), (real)(0.0f)); }

/// The patch of column `column`, which begins at the centre of that texel, and row `row`, which ends at the centre of
/// that one.
INLINE void load_patch(const EnvironmentArrays* environment, const uint* column, const uint* row, Patch* patch) {
    const uint width = environment->record->width, height = environment->record->height;
    uint index[2][2][LANES];
    for (uint lane = 0; lane < LANES; ++lane) {
        const uint above = max(row[lane], 1u) - 1, below = min(row[lane], height - 1);
        const uint right = column[lane] + 1 < width ? column[lane] + 1 : 0;
        index[0][0][lane] = above * width + column[lane];
        index[0][1][lane] = above * width + right;
        index[1][0][lane] = below * width + column[lane];
        index[1][1][lane] = below * width + right;
    }
    for (uint j = 0; j < 2; ++j)
        for (uint i = 0; i < 2; ++i) {
            load_vectors(environment->texels, 3, index[j][i], &patch->corners[j][i]);
            patch->weights[j][i] = luminance(&patch->corners[j][i]);
#if COMPENSATED
            patch->weights[j][i] = GREATER(patch->weights[j][i] - environment->record->floor, (real)(0.0f));
#endif
        }
    const real begin = TO_REAL(LOAD_LANES(row)) - 0.5f;
    patch->left = TO_REAL(LOAD_LANES(column)) + 0.5f;
    patch->top = GREATER(begin, (real)(0.0f));
    patch->height = LESSER(begin + 1.0f, (real)((float)height)) - patch->top;
}

/// Radiance `across` and `down` a patch, both in [0, 1].
INLINE void patch_radiance(const Patch* patch, real across, real down, Vector* radiance) {
    *radiance = patch->corners[0][0];
    mix3(across, &patch->corners[0][1], radiance);
    Vector below = patch->corners[1][0];
    mix3(across, &patch->corners[1][1], &below);
    mix3(down, &below, radiance);
}

/// Density, by solid angle, at a place of a patch that is chosen with `probability`. `sine` is that of the angle to the
/// picture's axis, where the density is infinite: it ends at a sine that floats hardly have room for.
INLINE real patch_density(const EnvironmentArrays* environment, const Patch* patch, real probability, real across,
                          real down, real sine) {
    const float scale =
        ((float)environment->record->width * (float)environment->record->height) * (0.5f * M_1_PI_F * M_1_PI_F);
    const real sum = (patch->weights[0][0] + patch->weights[0][1]) + (patch->weights[1][0] + patch->weights[1][1]);
    const real weight = mix_weights(mix_weights(patch->weights[0][0], patch->weights[0][1], across),
                                    mix_weights(patch->weights[1][0], patch->weights[1][1], across), down);
    const real relative = CHOOSE(sum > 0.0f, weight / (0.25f * sum), (real)(1.0f));
    return relative * (probability * scale / (patch->height * GREATER(sine, (real)(0x1p-64f))));
}

/// Where in [0, 1) a density that goes linearly from `first` to `last`, both >= 0, has the part u in [0, 1) before it.
INLINE real sample_linear(real first, real last, real u) {
    const real greatest = GREATER(first, last);
    const real a = first / greatest, b = last / greatest;
    const real place = u * (a + b) / (a + sqrt(fma(u, b * b - a * a, a * a)));
    return CHOOSE(place >= 0.0f, LESSER(place, (real)(BEFORE_ONE)), u); // both 0: as if the same everywhere
}
#endif

#if ENVIRONMENT
/// Radiance from a normalised direction, and the density, by solid angle, with which sample_environment draws it. In
/// lanes whose direction is anything else, it is anything.
INLINE void environment_light(const EnvironmentArrays* environment, const Vector* direction, Vector* radiance,
                              real* pdf) {
#if ENVIRONMENT == 1
    (void)direction;
    *pdf = (real)(0.5f * M_1_PI_F);
    spread3(vload3(0, environment->record->radiance), radiance);
#else
    const uint width = environment->record->width, height = environment->record->height;
    const real right = (real)((float)width), bottom = (real)((float)height);
    const real sine = sqrt(direction->x * direction->x + direction->z * direction->z);
    // By arctangents, which lose no digits at the poles. The middle is +x, the right of it +z, but for the picture's
    // own turn. NaN ends at the right and below.
    const real turn = 0.5f + 0.5f * atan2_pi(direction->z, direction->x) + environment->record->turn;
    const real x = LESSER((turn - CHOOSE(turn >= 1.0f, (real)(1.0f), (real)(0.0f))) * right, right);
    const real y = LESSER(atan2_pi(sine, direction->y) * bottom, bottom);
    // The last column of patches goes around to the first texel.
    const real x_left = x - 0.5f, x_around = CHOOSE(x_left < 0.0f, x_left + right, x_left);
    uint row[LANES], column[LANES];
    STORE_LANES(TO_WHOLE(LESSER(x_around, right - 1.0f)), column);
    STORE_LANES(TO_WHOLE(LESSER(y + 0.5f, bottom)), row);
    float of_row[LANES], of_column[LANES];
    for (uint lane = 0; lane < LANES; ++lane) {
        const float2 rows = vload2(0, environment->rows + row[lane]);
        const float2 columns = vload2(0, environment->columns + (size_t)row[lane] * (width + 1) + column[lane]);
        of_row[lane] = rows.y - rows.x;
        of_column[lane] = columns.y - columns.x;
    }
    Patch patch;
    load_patch(environment, column, row, &patch);
    const real across = LESSER(x_around + 0.5f - patch.left, (real)(1.0f));
    const real down = LESSER((y - patch.top) / patch.height, (real)(1.0f));
    patch_radiance(&patch, across, down, radiance);
    *pdf = patch_density(environment, &patch, LOAD_LANES(of_row) * LOAD_LANES(of_column), across, down, sine);
#endif
}

/// From the half of all directions that a surface sees, in the mean: of what directions are drawn by.
inline float drawn_irradiance(const EnvironmentArrays* environment) {
#if ENVIRONMENT == 2 && COMPENSATED
    return environment->record->irradiance_above_floor;
#else
    return environment->record->irradiance;
#endif
}

/// Draws a direction by u and v in [0, 1); tells its radiance and its density. `normal` is that of the surface, read
/// for a constant environment.
INLINE void sample_environment(const EnvironmentArrays* environment, const Vector* normal, real u, real v,
                               Vector* direction, Vector* radiance, real* pdf) {
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
    choose(environment->rows, height + 1, zero, &v, row, &of_row);
    choose(environment->columns, width, row, &u, column, &of_column);
    (void)normal;
    Patch patch;
    load_patch(environment, column, row, &patch);
    const real down =
        sample_linear(patch.weights[0][0] + patch.weights[0][1], patch.weights[1][0] + patch.weights[1][1], v);
    const real across = sample_linear(mix_weights(patch.weights[0][0], patch.weights[1][0], down),
                                      mix_weights(patch.weights[0][1], patch.weights[1][1], down), u);
    const real x = patch.left + across, y = fma(down, patch.height, patch.top);
    real sine, cosine, sine_across, cosine_across;
    sincos_turn(0.5f * (y / (float)height), &sine, &cosine);
    const real turn = x / (float)width - environment->record->turn;
    sincos_turn(turn + CHOOSE(turn < 0.0f, (real)(1.0f), (real)(0.0f)), &sine_across, &cosine_across);
    // Half a turn off: the middle of the picture is +x.
    const Vector d = {-(sine * cosine_across), cosine, -(sine * sine_across)};
    *direction = d;
    patch_radiance(&patch, across, down, radiance);
    *pdf = patch_density(environment, &patch, of_row * of_column, across, down, sine);
#endif
}
#endif

#endif
