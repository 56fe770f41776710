// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "boxwood/trace.hpp"

namespace boxwood {

/// How the light of a pixel is found:
/// - path: unidirectional path tracing of `depth` bounces.
/// - direct: the same with one bounce.
/// - ambient: the simplified model of dissertation 3.7.7: Lambert, point lights with shadows and an ambient light, each scaled by
///   ambient occlusion e^-t, over `depth` bounces.
/// - ao: ambient occlusion alone.
/// - normals: the shading normal as a colour.
/// - cost: bounding volumes tested for the pixel's ray.
enum class Integrator { path, direct, ambient, ao, normals, cost };

/// Where primary hits come from: traced rays, or the rasteriser, which gives the same.
enum class Primary { rays, raster };

/// Points for the integrals (cl/render/sampler.h).
enum class SamplerKind { sobol, stratified, random };

/// How direct light is sampled: towards lights, by the surface's reflection, or both with multiple importance sampling (Veach).
/// Lights without extent are always sampled towards.
enum class Strategy { mis, lights, bsdf };

/// How the diffuse lobe is sampled.
enum class Hemisphere { cosine, uniform };

/// Texture filters: along the beam's two axes, by the wider of them in three dimensions, or the nearest texel.
enum class TextureFilter { anisotropic, trilinear, nearest };

/// What decides about a picture's light.
struct LightOptions {
    Integrator integrator = Integrator::path;
    Primary primary = Primary::rays;
    SamplerKind sampler = SamplerKind::sobol;
    Strategy strategy = Strategy::mis;
    Hemisphere hemisphere = Hemisphere::cosine;
    TextureFilter filter = TextureFilter::anisotropic;
    std::uint32_t samples = 16; ///< Per pixel, 1 to 2^20.
    std::uint32_t depth = 6;    ///< Bounces, 0 to 64: light that is emitted, reflected once, ...
    std::uint64_t seed = 1;
    TraceOptions trace;
};

} // namespace boxwood
