// SPDX-License-Identifier: MIT
#include "cli/light.hpp"

#include <algorithm>
#include <numbers>
#include <optional>
#include <sstream>

#include <CLI/CLI.hpp>

#include "boxwood/error.hpp"
#include "boxwood/material.hpp"
#include "boxwood/render.hpp"
#include "cli/rays.hpp"

namespace boxwood::cli {

namespace {

/// An option whose values are words of an enumeration.
template <class Value, class Parse>
void add_words(CLI::App& command, const std::string& option, Value& target, const Parse& parse,
               const std::string& help) {
    command
        .add_option_function<std::string>(
            option,
            [&target, parse, option](const std::string& word) {
                try {
                    target = parse(word);
                } catch (const InputError& error) {
                    // Without the name of what is chosen, which the option's is.
                    throw CLI::ValidationError(option, std::string(error.what()).substr(error.file.size() + 2));
                }
            },
            help)
        ->type_name("WORD");
}

/// "R,G,B", within [0, largest_radiance].
std::optional<glm::vec3> to_radiance(const std::string& text) {
    std::istringstream stream(text);
    glm::vec3 color;
    char comma[2] = {};
    if (!(stream >> color.r >> comma[0] >> color.g >> comma[1] >> color.b)) return std::nullopt;
    if (comma[0] != ',' || comma[1] != ',' || !(stream >> std::ws).eof()) return std::nullopt;
    for (int c = 0; c < 3; ++c)
        if (!(color[c] >= 0.0f && color[c] <= largest_radiance)) return std::nullopt;
    return color;
}

bool lit(Device& device, const Scene& scene, const Tree& tree, Integrator integrator) {
    switch (integrator) {
    case Integrator::path:
    case Integrator::direct:
        return has_light(device, scene, tree);
    case Integrator::ambient: // it sees no other lamps
        return !scene.lights.empty();
    default:
        return true; // needs none
    }
}

/// Turns a picture by degrees.
void rotate(Surroundings& around, std::optional<double> rotation) {
    if (!rotation) return;
    if (around.environment.width == 0)
        throw UsageError("--environment-rotation: the environment is " + around.name +
                         ", the same from all sides; leave it out");
    around.environment.rotation = static_cast<float>(*rotation / 180.0 * std::numbers::pi);
}

} // namespace

LightOptions LightChoice::chosen() const {
    LightOptions chosen = options;
    if (spp->count() == 0 && chosen.integrator == Integrator::cost) chosen.samples = 1;     // as its preview shows them
    if (depth->count() == 0 && chosen.integrator == Integrator::ambient) chosen.depth = 2;  // dissertation 3.7.7
    if (chosen.integrator == Integrator::direct) chosen.depth = std::min(chosen.depth, 1u); // what is reported
    return chosen;
}

void add_light_options(CLI::App& command, LightChoice& choice) {
    LightOptions& options = choice.options;
    add_words(
        command, "--integrator", options.integrator, to_integrator,
        "path: path tracing (default); direct: the same with one bounce; ambient: Lambert, punctual lights and an "
        "occluded ambient light; ao: ambient occlusion; normals; cost: heat map of the bounding volumes tested");
    add_words(command, "--primary", options.primary, to_primary,
              "What the camera sees is found by rays (default) or by the rasteriser (raster)");
    choice.spp = command
                     .add_option("--spp", options.samples,
                                 "Samples per pixel (default: " + std::to_string(options.samples) + ", of cost 1)")
                     ->check(CLI::Range(1u, 1u << 20))
                     ->type_name("N");
    choice.depth = command
                       .add_option("--depth", options.depth,
                                   "Bounces of light, 0 to 64 (default: " + std::to_string(options.depth) +
                                       ", of ambient 2; of direct at most 1)")
                       ->check(CLI::Range(0u, 64u))
                       ->type_name("N");
    command.add_option("--seed", options.seed, "Seed of the samples (default: 1); the same seed gives the same bytes")
        ->check(CLI::NonNegativeNumber)
        ->type_name("N");
    add_words(command, "--sampler", options.sampler, to_sampler,
              "Points for the integrals: sobol (default), stratified or random");
    add_words(command, "--strategy", options.strategy, to_strategy,
              "Direct light is sampled by its lights, by the surface's reflection (bsdf), or by both (mis, default)");
    add_words(command, "--hemisphere", options.hemisphere, to_hemisphere,
              "Diffuse directions by cosine (default) or uniform");
    add_intersector(command, options.trace);
    add_words(command, "--filter", options.filter, to_filter,
              "Texture filter: anisotropic (default; for what the camera sees, itself or in mirrors), trilinear or "
              "nearest");
}

namespace {

Surroundings chosen_surroundings(const std::string& choice) {
    if (choice == "sky") return {default_sky(), "sky", {}};
    if (choice == "none" || choice.empty()) return {{}, "none", {}};
    if (const auto radiance = to_radiance(choice)) {
        Environment environment;
        environment.radiance = *radiance;
        return {environment, "constant", {}};
    }
    const std::filesystem::path file(choice);
    if (file.extension() != ".exr")
        throw UsageError("--environment \"" + choice +
                         "\" is none of FILE.exr, sky, none, and R,G,B (three numbers from 0 to 2^60)");
    Surroundings result{{}, file.filename().string(), {}};
    result.environment = load_environment(file, result.warnings);
    return result;
}

} // namespace

Surroundings surroundings(const std::string& choice, std::optional<double> rotation) {
    Surroundings around = chosen_surroundings(choice);
    rotate(around, rotation);
    return around;
}

Surroundings surroundings(Device& device, const Scene& scene, const Tree& tree, Integrator integrator,
                          std::optional<double> rotation) {
    return surroundings(lit(device, scene, tree, integrator) ? "none" : "sky", rotation);
}

} // namespace boxwood::cli
