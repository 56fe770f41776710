// SPDX-License-Identifier: MIT
// How a surface scatters light: glTF's metallic-roughness model (glTF 2.0 appendix B, KHR_materials_specular), a
// Lambert lobe under a GGX one. Directions are normalised, in the frame of the shading normal, z up, and point away
// from the surface.
//
// SPECULAR  1: both lobes; 0: the Lambert one alone, for scenes whose materials have no other
// UNIFORM_HEMISPHERE  1: the Lambert lobe is sampled uniformly, to see what cosines save; 0: by the cosine
#ifndef BOXWOOD_RENDER_BSDF_H
#define BOXWOOD_RENDER_BSDF_H
#include "render/turn.h"
#include "runtime/vector.h"

#if !defined(SPECULAR) || !defined(UNIFORM_HEMISPHERE)
#error "define SPECULAR (0 or 1) and UNIFORM_HEMISPHERE (0 or 1)"
#endif

/// A material at one point, seen from one direction.
typedef struct Bsdf {
    Vector diffuse; ///< Albedo of the Lambert lobe, before what the coat reflects is taken off.
#if SPECULAR
    Vector f0;               ///< Reflectance of the GGX lobe at normal incidence,
    real f90;                ///< and at grazing.
    real coat;               ///< [0, 1], strength of the dielectric's reflection, which the Lambert lobe lacks.
    real alpha;              ///< Width of the GGX lobe, SMALLEST_ALPHA or more.
    real mirror_probability; ///< Probability of taking the GGX lobe.
    real shadow_o;           ///< ggx_shadowing of the direction that it is seen from.
#endif
} Bsdf;

// A half vector is known to some 2^-24, so that below this its distance to the normal, in units of alpha, loses more
// than 11 bits. Squares and fourth powers of it stay in range. Perceptual roughness 0.011.
#define SMALLEST_ALPHA 0x1p-13f

INLINE real luminance3(const Vector* c) { return 0.2126f * c->x + 0.7152f * c->y + 0.0722f * c->z; }

#if SPECULAR
/// (1 - x)^5, x in [0, 1].
INLINE real schlick_weight(real x) {
    const real m = 1.0f - x, m2 = m * m;
    return m2 * m2 * m;
}

/// z (1 + 2 Lambda(w)) with Smith's shadowing term Lambda, which alone is infinite at grazing angles. At least alpha,
/// but for rounding.
INLINE real ggx_shadowing(const Vector* w, real alpha) {
    return sqrt(fma(w->z, w->z, (alpha * alpha) * fma(w->x, w->x, w->y * w->y)));
}

/// Probability of taking the GGX lobe, by what both lobes would reflect to `cosine`.
INLINE real specular_probability(const Bsdf* bsdf, real cosine) {
    const real weight = schlick_weight(LESSER(cosine, (real)(1.0f)));
    const real f0 = luminance3(&bsdf->f0), scattered = luminance3(&bsdf->diffuse);
    const real mirrored = fma(bsdf->f90 - f0, weight, f0); // the weights of a luminance add up to 1
    return CHOOSE(mirrored > 0.0f, mirrored / (mirrored + scattered), (real)(0.0f));
}
#endif

/// `roughness` is perceptual; everything in [0, 1]. What leaves to `wo` is asked for after that.
INLINE void make_bsdf(const Vector* base_color, real metallic, real roughness, real specular, const Vector* wo,
                      Bsdf* bsdf) {
    bsdf->diffuse = *base_color;
    scale3(1.0f - metallic, &bsdf->diffuse);
#if SPECULAR
    const real dielectric = specular * (1.0f - metallic), f0 = 0.04f * dielectric;
    const Vector normal = {fma(metallic, base_color->x, f0), fma(metallic, base_color->y, f0),
                           fma(metallic, base_color->z, f0)};
    bsdf->f0 = normal;
    bsdf->f90 = dielectric + metallic;
    bsdf->coat = specular;
    bsdf->alpha = GREATER(roughness * roughness, (real)(SMALLEST_ALPHA));
    bsdf->mirror_probability = specular_probability(bsdf, wo->z);
    bsdf->shadow_o = ggx_shadowing(wo, bsdf->alpha);
#else
    (void)roughness;
    (void)specular;
    (void)wo;
#endif
}

INLINE real lambert_pdf(real cosine) {
#if UNIFORM_HEMISPHERE
    (void)cosine;
    return (real)(0.5f * M_1_PI_F);
#else
    return cosine * M_1_PI_F;
#endif
}

/// f(wo, wi) cos wi and the density with which sample_bsdf draws wi, by solid angle. Both 0 unless both are above the
/// surface.
INLINE void evaluate_bsdf(const Bsdf* bsdf, const Vector* wo, const Vector* wi, Vector* value, real* pdf) {
    mask above = (wo->z > 0.0f) & (wi->z > 0.0f);
    *value = bsdf->diffuse;
#if SPECULAR
    // 2 cos(wo, h) h
    Vector sum;
    add3(wo, wi, &sum);
    const real sine2 = fma(sum.x, sum.x, sum.y * sum.y), cosine2 = sum.z * sum.z;
    const real square = sine2 + cosine2;
    const real narrow = fma(bsdf->alpha * bsdf->alpha, cosine2, sine2);
    above &= narrow > 0.0f; // else both along the surface
    const real weight = schlick_weight(LESSER(0.5f * sqrt(square), (real)(1.0f)));
    // sqrt(pi D(h)), with the distribution of microfacet normals D (Walter et al. 2007) in a form that does not cancel.
    const real peak = bsdf->alpha * (square / narrow);
    const real half_distribution = (0.5f * M_1_PI_F) * (peak * peak);
    const real shadow_i = ggx_shadowing(wi, bsdf->alpha);
    // G2 / (4 cos o) of heights that are correlated, and G1 / (4 cos o): the shadowing terms are not zero.
    const real mirrored = half_distribution / fma(wo->z / wi->z, shadow_i, bsdf->shadow_o);
    const real scattered = (1.0f - bsdf->coat * fma(weight, (real)(0.96f), (real)(0.04f))) * wi->z * M_1_PI_F;
    const Vector f0 = bsdf->f0;
    const real f90 = bsdf->f90;
    value->x = fma(fma(f90 - f0.x, weight, f0.x), mirrored, value->x * scattered);
    value->y = fma(fma(f90 - f0.y, weight, f0.y), mirrored, value->y * scattered);
    value->z = fma(fma(f90 - f0.z, weight, f0.z), mirrored, value->z * scattered);
    *pdf = fma(bsdf->mirror_probability, half_distribution / (wo->z + bsdf->shadow_o),
               (1.0f - bsdf->mirror_probability) * lambert_pdf(wi->z));
#else
    scale3(wi->z * M_1_PI_F, value);
    *pdf = lambert_pdf(wi->z);
#endif
    const Vector black = {(real)(0.0f), (real)(0.0f), (real)(0.0f)};
    choose3(NOT(above), &black, value);
    *pdf = CHOOSE(above, *pdf, (real)(0.0f));
}

/// A direction on the hemisphere for the Lambert lobe, by the sine and the cosine of its azimuth.
INLINE void lambert_direction(real sine, real cosine, real v, Vector* wi) {
#if UNIFORM_HEMISPHERE
    const real radius = sqrt(v * (2.0f - v)), z = 1.0f - v;
#else
    const real radius = sqrt(v), z = sqrt(1.0f - v);
#endif
    const Vector w = {radius * cosine, radius * sine, z};
    *wi = w;
}

INLINE void sample_lambert(real u, real v, Vector* wi) {
    real sine, cosine;
    sincos_turn(u, &sine, &cosine);
    lambert_direction(sine, cosine, v, wi);
}

#if SPECULAR
/// `wo` mirrored at a normal of the microfacets that it sees, drawn by their visible area (Dupuy and Benyoub 2023: a
/// cap of the sphere) at an azimuth.
INLINE void ggx_direction(const Vector* wo, real alpha, real sine, real cosine, real v, Vector* wi) {
    Vector view = {alpha * wo->x, alpha * wo->y, wo->z};
    normalise3(&view);
    const real height = (1.0f - v) * (1.0f + view.z), z = height - view.z;
    const real radius = sqrt(GREATER(fma(-z, z, (real)(1.0f)), (real)(0.0f)));
    const Vector normal = {alpha * fma(radius, cosine, view.x), alpha * fma(radius, sine, view.y), height};
    const real square = dot3(&normal, &normal);
    // Zero only where wo is below the surface.
    const real twice = CHOOSE(square > 0.0f, 2.0f * dot3(wo, &normal) / square, (real)(0.0f));
    const Vector w = {fma(twice, normal.x, -wo->x), fma(twice, normal.y, -wo->y), fma(twice, normal.z, -wo->z)};
    *wi = w;
    normalise3(wi);
}
#endif

/// Draws *wi; `choice` in [0, 1) takes the lobe. What is drawn may lie below the surface: then evaluate_bsdf gives 0.
INLINE void sample_bsdf(const Bsdf* bsdf, const Vector* wo, real choice, real u, real v, Vector* wi) {
    real sine, cosine;
    sincos_turn(u, &sine, &cosine);
    lambert_direction(sine, cosine, v, wi);
#if SPECULAR
    const mask mirror = choice < bsdf->mirror_probability;
    if (ANY(mirror)) {
        Vector mirrored;
        ggx_direction(wo, bsdf->alpha, sine, cosine, v, &mirrored);
        choose3(mirror, &mirrored, wi);
    }
#else
    (void)bsdf;
    (void)wo;
    (void)choice;
#endif
}

#endif
