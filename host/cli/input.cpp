// SPDX-License-Identifier: MIT
#include "cli/input.hpp"

#include <algorithm>
#include <iostream>

#include "boxwood/area_probe.hpp"
#include "boxwood/bxw.hpp"
#include "boxwood/gltf.hpp"
#include "boxwood/rays.hpp"
#include "boxwood/rounding.hpp"
#include "common/excerpt.hpp"

namespace boxwood::cli {

void print_warnings(const std::filesystem::path& file, const std::vector<std::string>& warnings) {
    constexpr std::size_t most = 5;
    constexpr std::size_t longest_warning = 1000; // those of a .bxw file hold anything
    for (std::size_t i = 0; i < std::min(most, warnings.size()); ++i) {
        std::cerr << "boxwood: warning: " << file.string() << ": " << excerpt(warnings[i], longest_warning) << '\n';
    }
    if (warnings.size() > most)
        std::cerr << "boxwood: warning: " << file.string() << ": and " << warnings.size() - most
                  << " more, all in the report\n";
}

Input load_input(const std::filesystem::path& file, bool quiet) {
    Input input{file, {}, {}};
    if (is_bxw(file)) {
        BxwFile stored = load_bxw(file);
        input.scene = std::move(stored.scene);
        input.tree = std::move(stored.tree);
    } else {
        input.scene = load_gltf(file);
    }
    if (!quiet) print_warnings(file, input.scene.warnings);
    return input;
}

namespace {

/// What --areas names; of lights and of a probe from the scene's first camera, those that are worth it.
std::vector<InfluenceArea> areas_of(Device& device, const Input& input, const BuildChoice& choice,
                                    std::vector<ProbedArea>& probed) {
    if (choice.areas == "none") return {};
    if (choice.areas == "lights") {
        probed = judge_areas(device, input.scene, areas_from_lights(input.scene), choice.options);
    } else if (choice.areas == "probe") {
        const Camera camera = input.scene.cameras.empty() ? default_camera(input.scene) : input.scene.cameras[0];
        probed = probe_areas(device, input.scene, camera, choice.options);
    } else {
        return load_areas(choice.areas);
    }
    std::vector<InfluenceArea> areas;
    for (const ProbedArea& each : probed)
        if (each.kept) areas.push_back(each.area);
    return areas;
}

Prepared stored_or_built(Device& device, const Input& input, const BuildChoice& choice) {
    if (!input.tree) {
        BuildOptions options = choice.options;
        std::vector<ProbedArea> probed;
        options.areas = areas_of(device, input, choice, probed);
        if (options.areas.empty() && needs_areas(options.builder))
            options.builder = Builder::sah; // no area is worth it
        BuildReport report;
        Tree tree = build(device, input.scene, options, &report);
        options.layout = tree.layout();
        options.area_index = tree.area_index();
        return {std::move(tree), options, std::move(report), std::move(probed), {}};
    }
    if (choice.given())
        throw UsageError(input.file.string() +
                         " brings its tree: leave the build options out, or give the scene that it was built from");
    BuildOptions options;
    options.layout = input.tree->layout;
    options.levels = input.tree->levels;
    options.bounds.kind = input.tree->bounds;
    options.area_index = input.tree->area_index.kind;
    options.areas.resize(input.tree->areas.size()); // that there are some is all that is read of them
    return {upload(device, *input.tree), options, std::nullopt, {}, {}};
}

} // namespace

Prepared prepare(Device& device, const Input& input, const BuildChoice& choice, bool quiet) {
    Prepared prepared = stored_or_built(device, input, choice);
    prepared.warnings = rounding_warnings(input.scene, prepared.options);
    if (!quiet) print_warnings(input.file, prepared.warnings);
    return prepared;
}

std::vector<std::string> rounding_warnings(const Scene& scene, const BuildOptions& options) {
    const bool areas = !options.areas.empty();
    if (options.levels == Levels::two || (options.levels == Levels::automatic && !areas)) return {};
    const std::optional<Rounding> worst = worst_rounding(scene);
    if (!worst) return {};
    return {"one level moves vertices of " + words(*worst, scene) +
            (areas ? "; build without --areas, which needs one level" : "; build with --levels two")};
}

} // namespace boxwood::cli
