// SPDX-License-Identifier: MIT
// How a surface scatters light: glTF's metallic-roughness model (glTF 2.0 appendix B, KHR_materials_specular), a Lambert lobe
// under a GGX one. Directions are normalised, in the frame of the shading normal, z up, and point away from the surface.
//
// SPECULAR  1: both lobes; 0: the Lambert one alone, for scenes whose materials have no other
// UNIFORM_HEMISPHERE  1: the Lambert lobe is sampled uniformly, to see what cosines save; 0: by the cosine
#ifndef BOXWOOD_RENDER_BSDF_H
#define BOXWOOD_RENDER_BSDF_H
#include "runtime/inline.h"
#include "runtime/numerics.h"

#if !defined(SPECULAR) || !defined(UNIFORM_HEMISPHERE)
#error "define SPECULAR (0 or 1) and UNIFORM_HEMISPHERE (0 or 1)"
#endif

/// A material at one point.
typedef struct Bsdf {
    float3 diffuse; ///< Albedo of the Lambert lobe, before what the coat reflects is taken off.
#if SPECULAR
    float3 f0;   ///< Reflectance of the GGX lobe at normal incidence,
    float f90;   ///< and at grazing.
    float coat;  ///< [0, 1], strength of the dielectric's reflection, which the Lambert lobe lacks.
    float alpha; ///< Width of the GGX lobe, SMALLEST_ALPHA or more.
#endif
} Bsdf;

// A half vector is known to some 2^-24, so that below this its distance to the normal, in units of alpha, loses more than 11
// bits. Squares and fourth powers of it stay in range. Perceptual roughness 0.011.
#define SMALLEST_ALPHA 0x1p-13f

/// `roughness` is perceptual; everything in [0, 1].
INLINE void make_bsdf(float3 base_color, float metallic, float roughness, float specular, Bsdf* bsdf) {
    bsdf->diffuse = base_color * (1.0f - metallic);
#if SPECULAR
    bsdf->f0 = (float3)(0.04f * specular * (1.0f - metallic)) + metallic * base_color;
    bsdf->f90 = specular * (1.0f - metallic) + metallic;
    bsdf->coat = specular;
    bsdf->alpha = fmax(roughness * roughness, SMALLEST_ALPHA);
#else
    (void)roughness;
    (void)specular;
#endif
}

INLINE float luminance(float3 c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

#if SPECULAR
/// (1 - x)^5, x in [0, 1].
INLINE float schlick_weight(float x) {
    const float m = 1.0f - x, m2 = m * m;
    return m2 * m2 * m;
}

/// Normalised distribution of microfacet normals (Walter et al. 2007), in a form that does not cancel near z = 1.
INLINE float ggx_distribution(float3 h, float alpha) {
    const float a2 = alpha * alpha;
    const float t = (h.x * h.x + h.y * h.y) + a2 * (h.z * h.z);
    return a2 * M_1_PI_F / (t * t);
}

/// z (1 + 2 Lambda(w)) with Smith's shadowing term Lambda, which alone is infinite at grazing angles.
INLINE float ggx_shadowing(float3 w, float alpha) {
    return sqrt(w.z * w.z + (alpha * alpha) * (w.x * w.x + w.y * w.y));
}

/// Probability of taking the GGX lobe.
INLINE float specular_share(const Bsdf* bsdf, float cosine) {
    const float weight = schlick_weight(LESSER(cosine, 1.0f));
    const float mirrored = luminance(bsdf->f0 + ((float3)(bsdf->f90) - bsdf->f0) * weight);
    const float scattered = luminance(bsdf->diffuse);
    return mirrored > 0.0f ? mirrored / (mirrored + scattered) : 0.0f;
}

/// A normal of the microfacets that `wo` sees, by their visible area (Dupuy and Benyoub 2023: a cap of the sphere).
INLINE float3 sample_visible_normal(float3 wo, float alpha, float2 u) {
    const float3 stretched = (float3)(alpha * wo.x, alpha * wo.y, wo.z);
    const float3 view = stretched / sqrt(dot(stretched, stretched));
    const float z = fma(1.0f - u.y, 1.0f + view.z, -view.z);
    const float radius = sqrt(clamp(1.0f - z * z, 0.0f, 1.0f));
    const float3 h = (float3)(radius * cospi(2.0f * u.x), radius * sinpi(2.0f * u.x), z) + view;
    const float3 normal = (float3)(alpha * h.x, alpha * h.y, h.z);
    const float square = dot(normal, normal);
    return square > 0.0f ? normal / sqrt(square) : (float3)(0.0f, 0.0f, 1.0f);
}
#endif

INLINE float lambert_pdf(float cosine) {
#if UNIFORM_HEMISPHERE
    (void)cosine;
    return 0.5f * M_1_PI_F;
#else
    return cosine * M_1_PI_F;
#endif
}

/// f(wo, wi) cos wi and the density with which sample_bsdf draws wi, by solid angle. Both 0 unless both are above the surface.
INLINE void evaluate_bsdf(const Bsdf* bsdf, float3 wo, float3 wi, float3* value, float* pdf) {
    *value = (float3)(0.0f);
    *pdf = 0.0f;
    if (!(wo.z > 0.0f && wi.z > 0.0f)) return;
#if SPECULAR
    const float3 sum = wo + wi;
    const float square = dot(sum, sum);
    if (!(square > 0.0f)) return; // both along the surface
    const float3 h = sum / sqrt(square);
    const float weight = schlick_weight(clamp(dot(wo, h), 0.0f, 1.0f));
    const float3 fresnel = bsdf->f0 + ((float3)(bsdf->f90) - bsdf->f0) * weight;
    const float distribution = ggx_distribution(h, bsdf->alpha);
    const float shadow_o = ggx_shadowing(wo, bsdf->alpha), shadow_i = ggx_shadowing(wi, bsdf->alpha);
    const float share = specular_share(bsdf, wo.z);
    // G2 / (4 cos o) of heights that are correlated, and G1 / (4 cos o): the shadowing terms are SMALLEST_ALPHA or more.
    *value = fresnel * (0.5f * distribution / (shadow_o + wo.z * shadow_i / wi.z)) +
             bsdf->diffuse * ((1.0f - bsdf->coat * (0.04f + 0.96f * weight)) * wi.z * M_1_PI_F);
    *pdf = share * (0.5f * distribution / (wo.z + shadow_o)) + (1.0f - share) * lambert_pdf(wi.z);
#else
    *value = bsdf->diffuse * (wi.z * M_1_PI_F);
    *pdf = lambert_pdf(wi.z);
#endif
}

/// A direction on the hemisphere for the Lambert lobe.
INLINE float3 sample_lambert(float2 u) {
#if UNIFORM_HEMISPHERE
    const float z = 1.0f - u.y;
    const float radius = sqrt(clamp(1.0f - z * z, 0.0f, 1.0f));
#else
    const float radius = sqrt(u.y), z = sqrt(1.0f - u.y);
#endif
    return (float3)(radius * cospi(2.0f * u.x), radius * sinpi(2.0f * u.x), z);
}

/// Draws *wi; `choice` in [0, 1) takes the lobe. What is drawn may lie below the surface: then evaluate_bsdf gives 0.
INLINE void sample_bsdf(const Bsdf* bsdf, float3 wo, float choice, float2 u, float3* wi) {
#if SPECULAR
    if (choice < specular_share(bsdf, wo.z)) {
        const float3 h = sample_visible_normal(wo, bsdf->alpha, u);
        const float3 mirrored = h * (2.0f * dot(wo, h)) - wo;
        *wi = mirrored / sqrt(dot(mirrored, mirrored));
        return;
    }
#else
    (void)bsdf;
    (void)wo;
    (void)choice;
#endif
    *wi = sample_lambert(u);
}

#endif
