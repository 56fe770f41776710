// SPDX-License-Identifier: MIT
// boxwood study influence: builders that know the rays against builders that do not (paper section 9).
#include <algorithm>
#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>

#include "cli/progress.hpp"
#include "cli/report.hpp"
#include "cli/study_summary.hpp"

namespace boxwood::cli {

namespace {

struct Arguments {
    Common common;
    std::filesystem::path areas;
    std::filesystem::path scenes;
    std::filesystem::path published;
    std::filesystem::path report;
    std::uint32_t rays = 10000;
    std::uint64_t seed = 1;
    bool parameters = false;
};

using Scenes = std::map<std::string, Mesh>;

/// The scenes at hand; the others are listed as left out, and their configurations dropped. Throws InputError where
/// none is left.
Scenes load_scenes(const Arguments& arguments, std::vector<Configuration>& configurations, InfluenceStudy& study) {
    std::error_code ignored;
    if (!std::filesystem::is_directory(arguments.scenes, ignored))
        throw InputError(arguments.scenes.string(), "", "is not a folder of scenes");
    Scenes scenes;
    std::vector<Configuration> kept;
    for (const Configuration& configuration : configurations) {
        const std::string& name = configuration.scene;
        if (std::ranges::find(study.left_out, name) != study.left_out.end()) continue;
        if (!scenes.contains(name)) {
            std::optional<Mesh> mesh = load_study_scene(name, arguments.scenes, arguments.seed);
            if (!mesh) {
                study.left_out.push_back(name);
                continue;
            }
            scenes[name] = std::move(*mesh);
        }
        kept.push_back(configuration);
    }
    if (kept.empty())
        throw InputError(arguments.areas.string(), "",
                         "has no area whose scene is in " + arguments.scenes.string() + " as pah_NAME.glb");
    configurations = std::move(kept);
    return scenes;
}

Json options_report(const Arguments& arguments, const InfluenceStudy& study) {
    Json options = {{"areas", arguments.areas.string()},
                    {"scenes", arguments.scenes.string()},
                    {"published", arguments.published.string()},
                    {"rays", arguments.rays},
                    {"seed", arguments.seed}};
    for (const StudyBuilder& builder : study.builders) {
        const TopDownOptions& each = builder.options;
        options["builders"][builder.name] = {{"measure", each.measure},
                                             {"cost", each.cost},
                                             {"axes", each.axes},
                                             {"bins", each.bins},
                                             {"max_leaf_primitives", each.max_leaf_primitives},
                                             {"split_plane_quality", each.split_plane_quality},
                                             {"acceptable_children", each.acceptable_children},
                                             {"excellent_children", each.excellent_children},
                                             {"costed_leaves", builder.costed_leaves},
                                             {"share", builder.share}};
    }
    return options;
}

/// Not a multiple of the generator's own step, or the rays of one seed would be those of another from some draw on.
std::uint64_t first_ray_seed(const Arguments& arguments) {
    return 0x9e3779b97f4a7c15u + (arguments.seed - 1) * 0xd1342543de82ef95u;
}

void study_all(Device& device, const Arguments& arguments, const Scenes& scenes,
               const std::vector<Configuration>& configurations, const Published& published, InfluenceStudy& study,
               Progress& progress) {
    for (std::size_t i = 0; i < configurations.size(); ++i) {
        const Configuration& configuration = configurations[i];
        progress.step(configuration.name());
        // The same rays for all builders, and others in each configuration.
        const std::vector<Ray> rays = area_rays(configuration.record, arguments.rays, first_ray_seed(arguments) + i);
        const Mesh& scene = scenes.at(configuration.scene);
        study.results.push_back(study_configuration(device, configuration, scene, study.builders, rays));
        const auto found = published.find(configuration.name());
        if (found != published.end()) study.results.back().published = found->second;
        if (!study.cases.empty())
            study.case_results.push_back(study_configuration(device, configuration, scene, study.cases, rays));
    }
}

void run(const Arguments& arguments) {
    check_output(arguments.report, "");
    InfluenceStudy study;
    study.builders = study_builders();
    if (arguments.parameters) study.cases = parameter_cases();
    std::vector<Configuration> configurations = load_configurations(arguments.areas);
    Published published;
    if (!arguments.published.empty()) published = load_published(arguments.published);
    const Scenes scenes = load_scenes(arguments, configurations, study);
    study.published =
        std::ranges::any_of(configurations, [&](const auto& each) { return published.contains(each.name()); });
    if (!arguments.published.empty() && !study.published)
        throw InputError(arguments.published.string(), "", "has no line of a configuration that is studied");
    Device device = open_device(arguments.common);
    Progress progress(arguments.common.quiet, configurations.size());
    study_all(device, arguments, scenes, configurations, published, study, progress);

    Json report = {{"boxwood", BOXWOOD_VERSION},
                   {"device", device_report(device.info())},
                   {"options", options_report(arguments, study)}};
    add_study(study, report);
    save_report(arguments.report, report);
    progress.clear();
    if (!arguments.common.quiet) {
        std::cout << configurations.size() << " configurations, " << grouped(arguments.rays) << " rays each\n";
        print_study(study);
    }
    if (arguments.common.profile) print_profile(device, {});
}

} // namespace

Command add_study(CLI::App& tool) {
    CLI::App* app = tool.add_subcommand("study", "Experiments that set speed against accuracy");
    app->require_subcommand(1);
    CLI::App* influence = app->add_subcommand(
        "influence", "Builders that know the rays of influence areas beside those that do not, by what the rays cost");
    const auto arguments = std::make_shared<Arguments>();
    influence->add_option("--areas", arguments->areas, "JSON list of areas with their scenes and orientations")
        ->required();
    influence
        ->add_option("--scenes", arguments->scenes,
                     "Folder of the scenes, pah_NAME.glb; Random100 and Random1000 are made")
        ->required();
    influence->add_option("--published", arguments->published, "CSV file of published costs to set beside");
    influence->add_option("--rays", arguments->rays, "Rays in each configuration (default: 10000)")
        ->check(CLI::Range(1u, 100000000u));
    influence->add_option("--seed", arguments->seed, "Of the rays and of the random scenes (default: 1)")
        ->check(CLI::NonNegativeNumber);
    influence->add_flag("--parameters", arguments->parameters, "Study the thresholds of the paper's table 2 as well");
    influence->add_option("--report", arguments->report, "JSON report to write");
    add_common(*influence, arguments->common);
    add_example(*influence, "  boxwood study influence --areas areas.json --scenes scenes --report study.json");
    return {app, [arguments] { run(*arguments); }};
}

} // namespace boxwood::cli
