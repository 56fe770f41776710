// SPDX-License-Identifier: MIT
#include "boxwood/render_options.hpp"

#include "common/words.hpp"

namespace boxwood {

namespace {

constexpr Words<Integrator, 6> integrators = {{{"path", Integrator::path},
                                               {"direct", Integrator::direct},
                                               {"ambient", Integrator::ambient},
                                               {"ao", Integrator::ao},
                                               {"normals", Integrator::normals},
                                               {"cost", Integrator::cost}}};
constexpr Words<Primary, 2> primaries = {{{"rays", Primary::rays}, {"raster", Primary::raster}}};
constexpr Words<SamplerKind, 3> samplers = {
    {{"sobol", SamplerKind::sobol}, {"stratified", SamplerKind::stratified}, {"random", SamplerKind::random}}};
constexpr Words<Strategy, 3> strategies = {
    {{"mis", Strategy::mis}, {"lights", Strategy::lights}, {"bsdf", Strategy::bsdf}}};
constexpr Words<Hemisphere, 2> hemispheres = {{{"cosine", Hemisphere::cosine}, {"uniform", Hemisphere::uniform}}};
constexpr Words<TextureFilter, 3> filters = {{{"anisotropic", TextureFilter::anisotropic},
                                              {"trilinear", TextureFilter::trilinear},
                                              {"nearest", TextureFilter::nearest}}};

} // namespace

std::string_view name(Integrator integrator) { return word_of(integrators, integrator); }
std::string_view name(Primary primary) { return word_of(primaries, primary); }
std::string_view name(SamplerKind sampler) { return word_of(samplers, sampler); }
std::string_view name(Strategy strategy) { return word_of(strategies, strategy); }
std::string_view name(Hemisphere hemisphere) { return word_of(hemispheres, hemisphere); }
std::string_view name(TextureFilter filter) { return word_of(filters, filter); }
Integrator to_integrator(std::string_view word) { return value_of(integrators, "integrator", word); }
Primary to_primary(std::string_view word) { return value_of(primaries, "primary", word); }
SamplerKind to_sampler(std::string_view word) { return value_of(samplers, "sampler", word); }
Strategy to_strategy(std::string_view word) { return value_of(strategies, "strategy", word); }
Hemisphere to_hemisphere(std::string_view word) { return value_of(hemispheres, "hemisphere", word); }
TextureFilter to_filter(std::string_view word) { return value_of(filters, "filter", word); }

} // namespace boxwood
