// SPDX-License-Identifier: MIT
// boxwood quality: every kind of bounding volume side by side (dissertation 4.2, tables 4 and 5).
#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>

#include "boxwood/requirements.hpp"
#include "cli/quality_report.hpp"
#include "cli/quality_study.hpp"

namespace boxwood::cli {

namespace {

struct Arguments {
    Common common;
    std::filesystem::path scene;
    std::filesystem::path report;
    QualityChoice choice;
};

/// Whether the scene's single level is to be set beside its two levels: with --levels auto, and more than one mesh.
bool compares_levels(const Arguments& arguments, const Scene& scene) {
    return arguments.choice.options.levels == Levels::automatic && scene.meshes.size() > 1;
}

LevelsComparison compare_levels(Device& device, const Scene& scene, const QualityChoice& choice,
                                const QualityStudy& study, Progress& progress) {
    std::map<std::string, BuildReport> studied;
    for (const KindResult& kind : study.kinds) studied[kind.key] = *kind.prepared.report;
    const bool two = requirements(scene, choice.options).two_levels;
    auto other = measure_levels(device, scene, choice, two ? Levels::one : Levels::two, progress);
    return two ? LevelsComparison{std::move(other), std::move(studied)}
               : LevelsComparison{std::move(studied), std::move(other)};
}

void run(const Arguments& arguments) {
    check_output(arguments.report, "");
    const std::size_t kinds = kinds_of(arguments.choice).size();
    Progress progress(arguments.common.quiet, 1 + study_steps(kinds) + kinds);
    progress.step("reading " + arguments.scene.string());
    Input input = load_input(arguments.scene, arguments.common.quiet);
    input.tree.reset(); // of a .bxw file: only its scene is wanted
    choose_camera(input, arguments.choice.rays.view,
                  arguments.choice.rays.resolution); // an unknown name is found before the work
    Device device = open_device(arguments.common);
    QualityStudy study = study_quality(device, input, arguments.choice, progress);
    LevelsComparison levels;
    if (compares_levels(arguments, input.scene))
        levels = compare_levels(device, input.scene, arguments.choice, study, progress);

    Prepared& control = study.kinds[0].prepared;
    control.warnings = rounding_warnings(input.scene, control.options);
    Json report = base_report(device, input, control, {"statistics"});
    add_quality(study, levels, report);
    const RayChoice& rays = arguments.choice.rays;
    report["options"]["resolution"] = {rays.resolution.width, rays.resolution.height};
    report["options"]["camera"] = choose_camera(input, rays.view, rays.resolution).name;
    report["options"]["seed"] = rays.seed;
    save_report(arguments.report, report);
    progress.clear();
    if (!arguments.common.quiet) {
        print_warnings(arguments.scene, control.warnings);
        std::cout << arguments.scene.string() << ": " << grouped(input.scene.triangle_count()) << " triangles in "
                  << grouped(input.scene.meshes.size()) << " meshes, " << grouped(input.scene.instances.size())
                  << " instances, binary layout, "
                  << (control.tree.levels() == Levels::two ? "two levels" : "one level") << '\n';
        print_quality(study, levels, control.tree.levels() == Levels::two);
    }
    if (arguments.common.profile) print_profile(device, control);
}

} // namespace

Command add_quality(CLI::App& tool) {
    CLI::App* app = tool.add_subcommand("quality", "Compare the kinds of bounding volumes on one scene");
    const auto arguments = std::make_shared<Arguments>();
    QualityChoice& choice = arguments->choice;
    app->add_option("SCENE", arguments->scene, "glTF 2.0 scene, or .bxw file, of which only the scene is used")
        ->required()
        ->type_name("");
    std::vector<std::string> words{"all"};
    for (std::string& word : bounds_words()) words.push_back(std::move(word));
    choice.words = {"all"};
    app->add_option("--bounds", choice.words,
                    "Kinds, separated by commas; aabb, the control, is always one (default: all)")
        ->delimiter(',')
        ->check(CLI::IsMember(words));
    add_levels(*app, choice.options);
    CLI::Option* extents = add_extents(*app, choice.options);
    extents->description(
        "Extents of obb-moments from all vertices (exact) or from the children's corners (default: both)");
    add_measure(*app, choice.options);
    add_morton(*app, choice.options);
    add_ray_options(*app, choice.rays);
    app->add_option("--report", arguments->report, "JSON report to write");
    add_common(*app, arguments->common);
    add_example(*app, "  boxwood quality hair.glb --bounds obb-points,obb-moments --report quality.json");
    return {app, [arguments, extents] {
                arguments->choice.extents_given = extents->count() > 0;
                run(*arguments);
            }};
}

} // namespace boxwood::cli
