// SPDX-License-Identifier: MIT
// boxwood render: a picture of a tree, as multi-channel OpenEXR and as a PNG preview.
#include <algorithm>
#include <chrono>
#include <iomanip>
#include <iostream>
#include <memory>

#include "boxwood/render.hpp"
#include "cli/input.hpp"
#include "cli/progress.hpp"
#include "cli/report.hpp"

namespace boxwood::cli {

namespace {

struct Arguments {
    Common common;
    std::filesystem::path input;
    std::filesystem::path output;
    std::filesystem::path report;
    std::string camera;
    std::vector<std::string> aovs;
    Resolution resolution;
    BuildChoice choice;

    std::filesystem::path preview() const { return std::filesystem::path(output).replace_extension(".png"); }
};

RenderOptions render_options(const Arguments& arguments) {
    RenderOptions options;
    options.width = arguments.resolution.width;
    options.height = arguments.resolution.height;
    for (const std::string& word : arguments.aovs) options.aovs.push_back(to_aov(word));
    return options;
}

/// The shading, or the heat map when cost alone is asked for.
void save_preview(const Arguments& arguments, const Image& image, Json& report) {
    if (arguments.aovs == std::vector<std::string>{"cost"}) {
        const HeatMap map = cost_preview(image);
        report["heat_map_top"] = map.top;
        save_png(arguments.preview(), image.width, image.height, map.rgb);
    } else {
        save_png(arguments.preview(), image.width, image.height, shading_preview(image));
    }
}

void run(const Arguments& arguments) {
    arguments.choice.check();
    check_output(arguments.output, ".exr");
    check_output(arguments.preview(), ".png");
    check_output(arguments.report, "");
    Progress progress(arguments.common.quiet, 4);
    progress.step("reading " + arguments.input.string());
    const Input input = load_input(arguments.input, arguments.common.quiet);
    const Camera camera = choose_camera(input, arguments.camera);
    progress.step("building");
    Device device = open_device(arguments.common);
    const Prepared prepared = prepare(device, input, arguments.choice);
    progress.step("rendering");
    const Geometry geometry = upload(device, input.scene);
    const RenderOptions options = render_options(arguments);
    const auto start = std::chrono::steady_clock::now();
    const Image image = render(device, prepared.tree, geometry, camera, options);
    const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();

    progress.step("writing " + arguments.output.string());
    Json picture = {{"image", arguments.output.string()}, {"preview", arguments.preview().string()}, {"ms", ms}};
    save_preview(arguments, image, picture);
    save_exr(arguments.output, image);
    std::vector<std::string> query;
    if (std::find(options.aovs.begin(), options.aovs.end(), Aov::cost) != options.aovs.end())
        query.push_back("statistics");
    Json report = base_report(device, input, prepared, query);
    report["options"]["resolution"] = {options.width, options.height};
    report["options"]["camera"] = camera.name;
    report["options"]["aovs"] = arguments.aovs;
    report["render"] = picture;
    save_report(arguments.report, report);
    progress.clear();
    if (!arguments.common.quiet)
        std::cout << arguments.output.string() << ": " << options.width << " x " << options.height << ", "
                  << image.channels.size() << " channels, camera \"" << camera.name << "\", " << std::fixed
                  << std::setprecision(1) << ms << " ms; preview " << arguments.preview().string() << '\n';
    if (arguments.common.profile) print_profile(device, prepared);
}

} // namespace

Command add_render(CLI::App& tool) {
    CLI::App* app = tool.add_subcommand("render", "Render a picture of a scene, with what each pixel met and cost");
    const auto arguments = std::make_shared<Arguments>();
    app->add_option("FILE", arguments->input, "glTF 2.0 scene, or .bxw file with its tree")->required()->type_name("");
    app->add_option("-o,--output", arguments->output, "OpenEXR file to write (.exr); a .png preview is put beside it")
        ->required();
    add_resolution(*app, arguments->resolution);
    app->add_option("--camera", arguments->camera,
                    "Name or index of the camera (default: the first, else a view of "
                    "everything)");
    std::vector<std::string> names;
    for (const Aov aov : all_aovs()) names.emplace_back(name(aov));
    app->add_option("--aov", arguments->aovs,
                    "Channels beside the shading, separated by commas; cost alone makes the preview a heat map")
        ->delimiter(',')
        ->check(CLI::IsMember(names));
    add_build_options(*app, arguments->choice);
    app->add_option("--report", arguments->report, "JSON report to write");
    add_common(*app, arguments->common);
    add_example(*app, "  boxwood render forest.bxw -o forest.exr --resolution 1280x720 --aov depth,normal");
    return {app, [arguments] { run(*arguments); }};
}

} // namespace boxwood::cli
