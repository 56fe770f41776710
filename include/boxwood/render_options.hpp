// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

#include "boxwood/trace.hpp"

namespace boxwood {

/// How the light of a pixel is found:
/// - path: unidirectional path tracing of `depth` bounces.
/// - direct: the same with one bounce.
/// - ambient: the simplified model of dissertation 3.7.7: Lambert, punctual lights with shadows, and an ambient light
///   scaled by the ambient occlusion 1 - e^-t, over `depth` bounces.
/// - ao: ambient occlusion alone.
/// - normals: the shading normal as a colour.
/// - cost: bounding volumes tested for the pixel's ray.
enum class Integrator { path, direct, ambient, ao, normals, cost };

/// Where primary hits come from: traced rays, or the rasteriser, which gives the same.
enum class Primary { rays, raster };

/// Points for the integrals (cl/render/sampler.h).
enum class SamplerKind { sobol, stratified, random };

/// How direct light is sampled: towards lights, by the surface's reflection, or both with multiple importance sampling
/// (Veach). Lights without extent are always sampled towards.
enum class Strategy { mis, lights, bsdf };

/// How the diffuse lobe is sampled.
enum class Hemisphere { cosine, uniform };

/// Texture filters: along the beam's two axes for what the camera sees, itself or in mirrors, and as the next one
/// beyond; by the wider of them in three dimensions; or the nearest texel.
enum class TextureFilter { anisotropic, trilinear, nearest };

/// The words used in options, reports and on the command line: "path", "raster", "sobol", ... to_... throw InputError
/// listing them.
std::string_view name(Integrator integrator);
std::string_view name(Primary primary);
std::string_view name(SamplerKind sampler);
std::string_view name(Strategy strategy);
std::string_view name(Hemisphere hemisphere);
std::string_view name(TextureFilter filter);
Integrator to_integrator(std::string_view word);
Primary to_primary(std::string_view word);
SamplerKind to_sampler(std::string_view word);
Strategy to_strategy(std::string_view word);
Hemisphere to_hemisphere(std::string_view word);
TextureFilter to_filter(std::string_view word);

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
