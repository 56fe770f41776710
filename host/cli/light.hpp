// SPDX-License-Identifier: MIT
// The options of `boxwood render` that decide about light.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "boxwood/environment.hpp"
#include "boxwood/render_options.hpp"
#include "boxwood/scene.hpp"
#include "boxwood/tree.hpp"
#include "cli/command.hpp"

namespace boxwood::cli {

/// --integrator, --primary, --sampler, --strategy, --hemisphere, --filter, --spp, --depth, --seed.
struct LightChoice {
    LightOptions options;
    CLI::Option* depth = nullptr;
    CLI::Option* spp = nullptr;

    /// The options, with the integrator's own depth and samples where none were given.
    LightOptions chosen() const;
};
void add_light_options(CLI::App& command, LightChoice& choice);

/// What lights a scene from outside, and how a summary calls it.
struct Surroundings {
    Environment environment;
    std::string name;                  ///< "none", "sky", "constant" or the file's name.
    std::vector<std::string> warnings; ///< Of the file.
};

/// Of --environment: a file, "sky", "none", or three numbers; none when empty. `rotation` in degrees. Throws UsageError
/// for another word and for a rotation of what is the same from all sides, InputError for a file that cannot be used.
Surroundings surroundings(const std::string& choice, std::optional<double> rotation);

/// Without --environment: the sky if nothing else lights the scene for this integrator, else none. Throws UsageError
/// for a rotation of none.
Surroundings surroundings(Device& device, const Scene& scene, const Tree& tree, Integrator integrator,
                          std::optional<double> rotation);

} // namespace boxwood::cli
