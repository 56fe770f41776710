// SPDX-License-Identifier: MIT
// boxwood render: a picture of a scene, as multi-channel OpenEXR and as a PNG preview.
#include <algorithm>
#include <iomanip>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <sstream>

#include <CLI/CLI.hpp>

#include "boxwood/rays.hpp"
#include "boxwood/render.hpp"
#include "boxwood/requirements.hpp"
#include "cli/areas.hpp"
#include "cli/input.hpp"
#include "cli/light.hpp"
#include "cli/render_work.hpp"
#include "cli/report.hpp"
#include "cli/view.hpp"
#include "common/excerpt.hpp"

namespace boxwood::cli {

namespace {

struct Arguments {
    Common common;
    std::filesystem::path input;
    std::filesystem::path output;
    std::filesystem::path report;
    View view;
    std::string environment;
    std::optional<double> environment_rotation; ///< Degrees.
    std::vector<std::string> aovs;
    std::optional<float> exposure;    ///< Of its own accord what suits the picture.
    std::optional<float> ao_distance; ///< > 0
    std::optional<double> checkpoint_seconds;
    bool resume = false;
    Resolution resolution;
    LightChoice light;
    BuildChoice choice;

    std::filesystem::path preview() const { return std::filesystem::path(output).replace_extension(".png"); }
    std::filesystem::path checkpoint() const { return output.string() + ".resume"; }
};

/// What was made, with what there is to say of it.
struct Result {
    Image image;
    Json report;
    RenderWork work;
    std::uint64_t rejected = 0;
    Profile profile;
};

/// Those that need no scene; the distance of ambient occlusion is filled in later.
RenderOptions render_options(const Arguments& arguments) {
    RenderOptions options;
    options.light = arguments.light.chosen();
    options.width = arguments.resolution.width;
    options.height = arguments.resolution.height;
    options.ao_distance = arguments.ao_distance.value_or(0.0f);
    const bool cost = options.light.integrator == Integrator::cost;
    if (cost) options.aovs.push_back(Aov::cost); // what the heat map is made of
    for (const std::string& word : arguments.aovs) {
        if (word == "all") {
            for (const Aov aov : all_aovs())
                if (has(options.light.integrator, aov)) options.aovs.push_back(aov);
            continue;
        }
        options.aovs.push_back(to_aov(word));
        if (!has(options.light.integrator, options.aovs.back()))
            throw UsageError("--aov " + word + ": the integrator " + std::string(name(options.light.integrator)) +
                             " has no such channels");
    }
    return options;
}

/// Whether a preview is of light, which has an exposure, not of numbers.
bool shows_light(Integrator integrator) {
    return integrator == Integrator::path || integrator == Integrator::direct || integrator == Integrator::ambient;
}

/// Light by the tone curve, other values as they are, costs as a heat map.
void save_preview(const Arguments& arguments, Integrator integrator, const Image& image, Json& report) {
    if (integrator == Integrator::cost) {
        const HeatMap map = cost_preview(image);
        report["heat_map_top"] = map.top;
        save_png(arguments.preview(), image.width, image.height, map.rgb);
        return;
    }
    const bool light = shows_light(integrator);
    PreviewOptions options{0.0f, light};
    if (light)
        report["exposure"] = options.exposure = arguments.exposure ? *arguments.exposure : suitable_exposure(image);
    save_png(arguments.preview(), image.width, image.height, preview(image, options));
}

Json light_report(const RenderOptions& options, const Surroundings& around) {
    const LightOptions& light = options.light;
    Json report = {{"integrator", name(light.integrator)},
                   {"primary", name(light.primary)},
                   {"sampler", name(light.sampler)},
                   {"strategy", name(light.strategy)},
                   {"hemisphere", name(light.hemisphere)},
                   {"intersector", name(light.trace.intersector)},
                   {"filter", name(light.filter)},
                   {"spp", light.samples},
                   {"depth", light.depth},
                   {"seed", light.seed},
                   {"environment", around.name},
                   {"resolution", {options.width, options.height}}};
    if (has(light.integrator, Aov::ao)) report["ao_distance"] = options.ao_distance;
    for (const Aov aov : without_repetition(options.aovs)) report["aovs"].push_back(name(aov));
    return report;
}

/// Device times of the samples by stage, and the share of the passes that trace rays.
void add_times(const Profile& profile, Json& report) {
    double traced = 0.0, total = 0.0;
    Json& stages = report["stages_ms"] = Json::object();
    for (const PassTime& pass : profile.passes) {
        Json& stage = stages[pass.stage];
        stage = (stage.is_null() ? 0.0 : stage.get<double>()) + pass.ms;
        total += pass.ms;
        if (pass.label == "closest hit" || pass.label == "any hit") traced += pass.ms;
    }
    report["trace_share"] = total > 0.0 ? traced / total : 0.0;
}

double samples_per_s(const RenderOptions& options, const RenderWork& work) {
    const double pixels = double{options.width * 1.0} * options.height;
    return work.ms > 0.0 ? pixels * (work.samples - work.resumed) / (1e-3 * work.ms) : 0.0;
}

Result render_picture(Device& device, const Arguments& arguments, const RenderOptions& options,
                      const std::string& environment, Render& render, const InterruptGuard& guard, Progress& progress) {
    if (arguments.resume) resume(render, arguments.checkpoint());
    device.take_profile();
    Result result;
    result.work = take_samples(device, render, options.light.samples,
                               {arguments.checkpoint(), arguments.checkpoint_seconds}, guard, progress);
    result.profile = device.take_profile();
    result.image = render.image();
    result.image.attributes["scene"] = arguments.input.stem().string();
    result.image.attributes["environmentName"] = environment;
    result.rejected = render.rejected_samples();
    result.report = {{"image", arguments.output.string()},
                     {"preview", arguments.preview().string()},
                     {"ms", result.work.ms},
                     {"samples", result.work.samples},
                     {"resumed_samples", result.work.resumed},
                     {"samples_per_s", samples_per_s(options, result.work)},
                     {"rejected_samples", result.rejected},
                     {"interrupted", result.work.interrupted},
                     {"channels", result.image.channels.size()}};
    add_times(result.profile, result.report);
    return result;
}

void print_summary(const Arguments& arguments, const RenderOptions& options, const Result& result, const Camera& camera,
                   const Surroundings& around) {
    const Integrator integrator = options.light.integrator;
    std::cout << arguments.output.string() << ": " << options.width << " x " << options.height << ", "
              << name(integrator) << ", " << result.work.samples << " samples per pixel, camera \""
              << excerpt(camera.name) << '"';
    if (shows_light(integrator))
        std::cout << ", environment " << around.name
                  << (around.name == "sky" && arguments.environment.empty() ? " (nothing else lights the scene)" : "");
    std::cout << "; " << std::fixed << std::setprecision(1) << result.work.ms << " ms, " << std::setprecision(2)
              << samples_per_s(options, result.work) / 1e6 << " million samples/s; preview "
              << arguments.preview().string() << '\n';
    if (result.rejected > 0)
        std::cerr << "boxwood: warning: " << grouped(result.rejected)
                  << " samples of pixels were no light and left out\n";
}

/// Throws UsageError when two of the files are one: what is read would be lost, or what is written first.
void check_distinct(const Arguments& arguments) {
    const std::string_view none;
    const bool picture = std::filesystem::path(arguments.environment).extension() == ".exr";
    const std::pair<std::string_view, std::filesystem::path> files[] = {
        {"the scene", arguments.input},
        {"--environment", picture ? arguments.environment : none},
        {"--output", arguments.output},
        {"the preview", arguments.preview()},
        {"the checkpoint", arguments.checkpoint()},
        {"--report", arguments.report}};
    std::map<std::filesystem::path, std::string_view> seen;
    for (const auto& [role, file] : files) {
        if (file.empty()) continue;
        std::error_code failure;
        const std::filesystem::path place = std::filesystem::weakly_canonical(std::filesystem::absolute(file), failure);
        const auto [first, fresh] = seen.emplace(failure ? file : place, role);
        if (!fresh)
            throw UsageError("\"" + file.string() + "\" is both " + std::string(first->second) + " and " +
                             std::string(role));
    }
}

/// Throws UsageError for options that the integrator would not heed.
void check_options(const Arguments& arguments) {
    const Integrator integrator = arguments.light.options.integrator;
    const std::string word(name(integrator));
    if (arguments.exposure && !shows_light(integrator))
        throw UsageError("--exposure: the preview of " + word + " shows no light; leave it out");
    if (arguments.ao_distance && !has(integrator, Aov::ao))
        throw UsageError("--ao-distance: the integrator " + word + " has no ambient occlusion; leave it out");
}

void check(const Arguments& arguments) {
    arguments.choice.check();
    check_options(arguments);
    check_output(arguments.output, ".exr");
    check_distinct(arguments);
    check_output(arguments.preview(), ".png");
    check_output(arguments.report, "");
    check_output(arguments.checkpoint(), "");
    const bool begun = std::filesystem::exists(arguments.checkpoint());
    if (arguments.resume && !begun)
        throw InputError(arguments.checkpoint().string(), "",
                         "there is no such checkpoint to resume from: leave --resume out to begin");
    if (!arguments.resume && begun && !arguments.common.quiet)
        std::cerr << "boxwood: warning: " << arguments.checkpoint().string()
                  << " is there: --resume goes on from it; this render starts anew\n";
}

/// Pictures and report. Where one of them cannot be written, or not all samples are taken, they are kept for another
/// run.
Kept write_outputs(const Arguments& arguments, const Render& render, Result& result, Json& report) {
    try {
        save_exr(arguments.output, result.image);
        save_preview(arguments, arguments.light.options.integrator, result.image, result.report);
        report["render"] = result.report;
        save_report(arguments.report, report);
        result.image = {};
        return result.work.interrupted ? keep_samples(render, result.work, arguments.checkpoint()) : Kept{};
    } catch (const OutputError& error) {
        const Kept kept = keep_samples(render, result.work, arguments.checkpoint());
        throw Error(error.what() + std::string(kept.all ? ", but " : ", and ") + kept.words);
    }
}

/// A checkpoint of a finished render is of no use; one that another render left is not this one's to remove.
void finish(const Arguments& arguments, const RenderWork& work, const Kept& kept, std::uint32_t samples) {
    if (work.interrupted)
        throw Interrupted("interrupted after " + std::to_string(work.samples) + " of " + std::to_string(samples) +
                          " samples: " + arguments.output.string() + " shows those, " + (kept.all ? "and " : "but ") +
                          kept.words);
    std::error_code ignored;
    if ((arguments.resume || work.saved) && std::filesystem::is_regular_file(arguments.checkpoint(), ignored))
        std::filesystem::remove(arguments.checkpoint(), ignored);
}

void run(const Arguments& arguments) {
    check(arguments);
    RenderOptions options = render_options(arguments);
    Device device = open_device(arguments.common);
    check_film(device, options);
    Progress progress(arguments.common.quiet, 3 + options.light.samples);
    progress.step("reading " + arguments.input.string());
    const Input input = load_input(arguments.input, arguments.common.quiet);
    const Camera camera = choose_camera(input, arguments.view, arguments.resolution);
    const std::optional<double> rotation = arguments.environment_rotation;
    Surroundings around;
    if (!arguments.environment.empty()) around = surroundings(arguments.environment, rotation);
    if (!arguments.ao_distance) options.ao_distance = default_ao_distance(input.scene);
    progress.step("building");
    const Prepared prepared = prepare(device, input, arguments.choice, arguments.common.quiet);
    if (arguments.environment.empty())
        around = surroundings(device, input.scene, prepared.tree, options.light.integrator, rotation);
    Render render(device, input.scene, prepared.tree, around.environment, camera, options);
    if (!arguments.common.quiet) {
        progress.clear();
        print_warnings(input.file, render.warnings());
        print_warnings(arguments.environment, around.warnings);
    }
    const InterruptGuard guard; // until all is written: a signal meanwhile cuts no output off
    Result result = render_picture(device, arguments, options, around.name, render, guard, progress);
    progress.step("writing " + arguments.output.string());

    std::vector<std::string> query = words(shading_requirements(input.scene));
    if (std::find(options.aovs.begin(), options.aovs.end(), Aov::cost) != options.aovs.end())
        query.push_back("statistics");
    Json report = base_report(device, input, prepared, query);
    if (!prepared.options.areas.empty() || !prepared.probed.empty())
        add_areas(download(device, prepared.tree), prepared, report);
    for (const std::string& warning : render.warnings()) report["scene"]["warnings"].push_back(warning);
    for (const std::string& warning : around.warnings)
        report["scene"]["warnings"].push_back(around.name + ": " + warning);
    report["options"].update(light_report(options, around));
    report["options"]["camera"] = camera.name;
    if (rotation) report["options"]["environment_rotation"] = *rotation;
    const Kept kept = write_outputs(arguments, render, result, report);
    progress.clear();
    if (!arguments.common.quiet) print_summary(arguments, options, result, camera, around);
    if (arguments.common.profile) print_profile(prepared, result.profile);
    finish(arguments, result.work, kept, options.light.samples);
}

/// Neither NaN, which CLI::Range lets pass, nor what becomes 0 as a float.
CLI::Validator number_within(double least, double most) {
    return CLI::Validator(
        [least, most](const std::string& text) {
            double value = 0.0;
            if (CLI::detail::lexical_cast(text, value) && value >= least && value <= most) return std::string();
            std::ostringstream message;
            message << text << " is no number from " << least << " to " << most;
            return message.str();
        },
        "");
}

void add_picture_options(CLI::App& app, Arguments& arguments) {
    add_resolution(app, arguments.resolution);
    add_view(app, arguments.view);
    app.add_option(
           "--environment", arguments.environment,
           "Light from all around: an OpenEXR picture of the sphere (FILE.exr), sky, none, or one radiance R,G,B "
           "(default: sky when neither lights nor lamps light the scene, else none)")
        ->type_name("LIGHT");
    app.add_option("--environment-rotation", arguments.environment_rotation,
                   "Turns the picture of the sphere, or the sky, about +y, counter-clockwise as seen from above "
                   "(default: 0, the middle of the picture at +x and the right of it at +z)")
        ->check(number_within(-360.0, 360.0))
        ->type_name("DEGREES");
    app.add_option("--ao-distance", arguments.ao_distance,
                   "World units at which a surface occludes by e^-1, for ambient and ao (default: a tenth of the "
                   "scene's diagonal)")
        ->check(number_within(std::numeric_limits<float>::min(), std::numeric_limits<float>::max()));
    app.add_option(
           "--exposure", arguments.exposure,
           "Stops by which the preview of path, direct and ambient is brighter (default: what suits the picture)")
        ->check(number_within(-64.0, 64.0))
        ->type_name("STOPS");
    std::vector<std::string> names = {"all"};
    for (const Aov aov : all_aovs()) names.emplace_back(name(aov));
    app.add_option("--aov", arguments.aovs,
                   "Channels beside R, G and B, separated by commas, or all of the integrator's; variance is that of "
                   "independent samples (--sampler random), more than that of the others")
        ->delimiter(',')
        ->check(CLI::IsMember(names));
}

} // namespace

Command add_render(CLI::App& tool) {
    CLI::App* app = tool.add_subcommand("render", "Render a picture of a scene, with what each pixel met and cost");
    const auto arguments = std::make_shared<Arguments>();
    app->add_option("FILE", arguments->input, "glTF 2.0 scene, or .bxw file with its tree")->required()->type_name("");
    app->add_option("-o,--output", arguments->output, "OpenEXR file to write (.exr); a .png preview is put beside it")
        ->required();
    add_light_options(*app, arguments->light);
    add_picture_options(*app, *arguments);
    app->add_option(
           "--checkpoint", arguments->checkpoint_seconds,
           "Save what is needed to go on, to IMAGE.exr.resume, after the sample during which so many seconds have "
           "passed; removed in the end. Ctrl-C saves it too")
        ->check(number_within(0.0, std::numeric_limits<double>::max()))
        ->type_name("SECONDS");
    app->add_flag("--resume", arguments->resume,
                  "Go on from IMAGE.exr.resume, with the other options as they were, to the same bytes");
    add_build_options(*app, arguments->choice);
    app->add_option("--report", arguments->report, "JSON report to write");
    add_common(*app, arguments->common);
    add_example(*app,
                "  boxwood render forest.bxw -o forest.exr --resolution 1280x720 --spp 64 --aov depth,normal\n"
                "  boxwood render room.glb -o room.exr --integrator ambient --environment 0.8,0.9,1 --exposure 1");
    return {app, [arguments] { run(*arguments); }};
}

} // namespace boxwood::cli
