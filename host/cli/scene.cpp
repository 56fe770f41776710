// SPDX-License-Identifier: MIT
// boxwood scene: makes a procedural scene.
#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>

#include "boxwood/gltf.hpp"
#include "boxwood/procedural.hpp"
#include "cli/command.hpp"
#include "cli/progress.hpp"
#include "cli/report.hpp"

namespace boxwood::cli {

namespace {

struct Arguments {
    Common common;
    std::string kind;
    std::filesystem::path output;
    ProceduralOptions options;
};

void run(const Arguments& arguments) {
    check_output(arguments.output, ".glb");
    Progress progress(arguments.common.quiet, 2);
    progress.step("making " + arguments.kind);
    const Scene scene = make_procedural(arguments.kind, arguments.options);
    progress.step("writing " + arguments.output.string());
    save_glb(arguments.output, scene);
    progress.clear();
    if (!arguments.common.quiet)
        std::cout << arguments.output.string() << ": " << grouped(scene.triangle_count()) << " triangles in "
                  << grouped(scene.meshes.size()) << " meshes, " << grouped(scene.instances.size()) << " instances ("
                  << grouped(scene.instanced_triangle_count()) << " triangles as seen)\n";
}

} // namespace

Command add_scene(CLI::App& tool) {
    CLI::App* app = tool.add_subcommand("scene", "Make a procedural scene");
    const auto arguments = std::make_shared<Arguments>();
    std::vector<std::string> kinds;
    std::string descriptions = "One of:";
    for (const ProceduralKind& kind : procedural_kinds()) {
        kinds.push_back(kind.name);
        descriptions += "\n" + kind.name + ": " + kind.description;
    }
    app->add_option("KIND", arguments->kind, descriptions)->required()->check(CLI::IsMember(kinds))->type_name("");
    app->add_option("-o,--output", arguments->output, "Binary glTF file to write (.glb)")->required();
    app->add_option("--triangles", arguments->options.triangles, "Wanted number of stored triangles")
        ->check(CLI::NonNegativeNumber);
    app->add_option("--instances", arguments->options.instances, "Wanted number of instances (forest)")
        ->check(CLI::NonNegativeNumber);
    app->add_option("--seed", arguments->options.seed, "Seed of all that is random (default: 1)")
        ->check(CLI::NonNegativeNumber);
    add_common(*app, arguments->common);
    add_example(*app, "  boxwood scene forest --instances 1000 -o forest.glb");
    return {app, [arguments] { run(*arguments); }};
}

} // namespace boxwood::cli
