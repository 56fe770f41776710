// SPDX-License-Identifier: MIT
// boxwood build: from a scene to a .bxw file.
#include <iomanip>
#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>

#include "boxwood/bxw.hpp"
#include "cli/areas.hpp"
#include "cli/input.hpp"
#include "cli/progress.hpp"
#include "cli/report.hpp"

namespace boxwood::cli {

namespace {

struct Arguments {
    Common common;
    std::filesystem::path scene;
    std::filesystem::path output;
    std::filesystem::path report;
    BuildChoice choice;
};

void print_summary(const Arguments& arguments, const Input& input, const Prepared& prepared) {
    const BuildReport& report = *prepared.report;
    std::cout << arguments.output.string() << ": " << grouped(input.scene.triangle_count()) << " triangles, "
              << grouped(input.scene.instances.size()) << " instances, " << name(prepared.tree.layout()) << ", "
              << name(prepared.tree.bounds()) << ", "
              << (prepared.tree.levels() == Levels::two ? "two levels" : "one level") << ", " << grouped(report.nodes)
              << " nodes, depth " << report.max_depth << ", built by " << name(prepared.options.builder) << " in "
              << std::fixed << std::setprecision(1) << report.total_ms << " ms (kernels " << report.profile.total_ms()
              << " ms)\n";
    if (arguments.choice.areas != "none" && prepared.options.areas.empty())
        std::cout << "no influence area by --areas " << arguments.choice.areas << ": a tree without any\n";
}

void run(const Arguments& arguments) {
    arguments.choice.check();
    check_output(arguments.output, ".bxw");
    check_output(arguments.report, "");
    Progress progress(arguments.common.quiet, 3);
    progress.step("reading " + arguments.scene.string());
    Input input = load_input(arguments.scene, arguments.common.quiet);
    input.tree.reset(); // of a .bxw file: only its scene is wanted
    progress.step("building");
    Device device = open_device(arguments.common);
    const Prepared prepared = prepare(device, input, arguments.choice, arguments.common.quiet);
    progress.step("writing " + arguments.output.string());
    const TreeImage image = download(device, prepared.tree);
    save_bxw(arguments.output, input.scene, image);
    Json report = base_report(device, input, prepared, {});
    add_areas(image, prepared, report);
    report["output"] = {{"file", arguments.output.string()}, {"bytes", std::filesystem::file_size(arguments.output)}};
    save_report(arguments.report, report);
    progress.clear();
    if (!arguments.common.quiet) {
        print_summary(arguments, input, prepared);
        std::cout << area_summary(image, prepared);
    }
    if (arguments.common.profile) print_profile(device, prepared);
}

} // namespace

Command add_build(CLI::App& tool) {
    CLI::App* app = tool.add_subcommand("build", "Build the tree of a scene and write both to a .bxw file");
    const auto arguments = std::make_shared<Arguments>();
    app->add_option("SCENE", arguments->scene, "glTF 2.0 scene, or .bxw file, of which only the scene is used")
        ->required()
        ->type_name("");
    app->add_option("-o,--output", arguments->output, "File to write (.bxw)")->required();
    add_build_options(*app, arguments->choice);
    app->add_option("--report", arguments->report, "JSON report to write");
    add_common(*app, arguments->common);
    add_example(*app, "  boxwood build forest.glb -o forest.bxw --report build.json");
    return {app, [arguments] { run(*arguments); }};
}

} // namespace boxwood::cli
