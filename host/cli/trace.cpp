// SPDX-License-Identifier: MIT
// boxwood trace: rays through a tree, timed and counted.
#include <algorithm>
#include <iomanip>
#include <iostream>
#include <memory>
#include <sstream>

#include <CLI/CLI.hpp>

#include "boxwood/rays.hpp"
#include "cli/areas.hpp"
#include "cli/input.hpp"
#include "cli/progress.hpp"
#include "cli/rays.hpp"
#include "cli/report.hpp"
#include "common/median.hpp"

namespace boxwood::cli {

namespace {

constexpr std::size_t timed_runs = 5;

struct Arguments {
    Common common;
    std::filesystem::path input;
    std::filesystem::path report;
    RayChoice rays;
    TraceOptions options;
    BuildChoice choice;
};

/// What the rays met and what it cost.
struct Result {
    std::uint64_t rays = 0;
    std::uint64_t hits = 0;
    double median_ms = 0.0;
    RayWork work;
    std::uint64_t checksum = 0; ///< Of all answers: equal results have equal checksums.
};

template <class T>
std::uint64_t checksum(const std::vector<T>& values) {
    std::uint64_t hash = 0xcbf29ce484222325u; // FNV-1a of the bytes
    const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
    for (std::size_t i = 0; i < values.size() * sizeof(T); ++i) hash = (hash ^ bytes[i]) * 0x100000001b3u;
    return hash;
}

/// Median wall clock of a launch; the first, which compiles, is not counted.
template <class Launch>
double median_ms(Device& device, Progress& progress, const Launch& launch_rays) {
    launch_rays();
    std::vector<double> times;
    for (std::size_t run = 0; run < timed_runs; ++run) {
        progress.step("tracing");
        times.push_back(timed_ms(device, launch_rays));
    }
    return median(times);
}

Result trace_closest(Device& device, const Tree& tree, const Buffer<Ray>& rays, const TraceOptions& options,
                     Progress& progress) {
    Buffer<Hit> hits = make_buffer<Hit>(device, rays.size(), "hits");
    Result result;
    result.median_ms = median_ms(device, progress, [&] { closest_hit(device, tree, rays, hits, options); });
    const std::vector<Hit> answers = download(device, hits);
    result.hits = static_cast<std::uint64_t>(
        std::count_if(answers.begin(), answers.end(), [](const Hit& hit) { return hit.primitive != BOXWOOD_NONE; }));
    result.checksum = checksum(answers);
    return result;
}

Result trace_any(Device& device, const Tree& tree, const Buffer<Ray>& rays, const TraceOptions& options,
                 Progress& progress) {
    Buffer<std::uint32_t> hits = make_buffer<std::uint32_t>(device, rays.size(), "hits");
    Result result;
    result.median_ms = median_ms(device, progress, [&] { any_hit(device, tree, rays, hits, options); });
    const std::vector<std::uint32_t> answers = download(device, hits);
    result.hits = static_cast<std::uint64_t>(std::count(answers.begin(), answers.end(), 1u));
    result.checksum = checksum(answers);
    return result;
}

void add_to_report(const Arguments& arguments, const Input& input, const Result& result, Json& report) {
    std::ostringstream hash;
    hash << std::hex << std::setw(16) << std::setfill('0') << result.checksum;
    Json& options = report["options"];
    options["rays"] = arguments.rays.kind;
    options["resolution"] = {arguments.rays.resolution.width, arguments.rays.resolution.height};
    options["intersector"] = name(arguments.options.intersector);
    options["camera"] = choose_camera(input, arguments.rays.view, arguments.rays.resolution).name;
    if (arguments.rays.kind == "diffuse" || arguments.rays.kind == "near") options["seed"] = arguments.rays.seed;
    if (arguments.rays.kind == "shadow") {
        const glm::vec3 light = default_light(input.scene);
        options["light"] = {light.x, light.y, light.z};
    }
    report["trace"] = {{"rays", result.rays},
                       {"hits", result.hits},
                       {"mrays_per_s", mrays_per_s(result.rays, result.median_ms)},
                       {"nodes_per_ray", result.work.volumes_per_ray},
                       {"primitives_per_ray", result.work.primitives_per_ray},
                       {"statistics_of", "closest_hit"},
                       {"timed_runs", timed_runs},
                       {"median_ms", result.median_ms},
                       {"checksum", hash.str()}};
    if (report.contains("areas")) {
        report["areas"]["affine_rays"] = result.work.affine_rays;
        report["areas"]["answered_locally"] = result.work.answered_locally;
    }
}

void print_summary(const Arguments& arguments, const Result& result) {
    std::cout << grouped(result.rays) << ' ' << arguments.rays.kind << " rays, " << grouped(result.hits) << " hits, "
              << std::fixed << std::setprecision(2) << mrays_per_s(result.rays, result.median_ms)
              << " Mray/s (median of " << timed_runs << "), " << result.work.volumes_per_ray << " volumes and "
              << result.work.primitives_per_ray << " triangles tested per ray\n";
    if (result.work.affine_rays > 0)
        std::cout << grouped(result.work.affine_rays) << " rays followed an influence area, "
                  << grouped(result.work.answered_locally) << " of them were answered by its tree\n";
}

void run(const Arguments& arguments) {
    arguments.choice.check();
    check_output(arguments.report, "");
    Progress progress(arguments.common.quiet, 4 + timed_runs);
    progress.step("reading " + arguments.input.string());
    const Input input = load_input(arguments.input, arguments.common.quiet);
    choose_camera(input, arguments.rays.view, arguments.rays.resolution); // an unknown name is found before the work
    progress.step("building");
    Device device = open_device(arguments.common);
    const Prepared prepared = prepare(device, input, arguments.choice, arguments.common.quiet);
    progress.step("making rays");
    Buffer<Ray> rays = make_rays(device, input, prepared.tree, arguments.rays);
    Result result;
    {
        const Stage stage(device, "trace");
        result = arguments.rays.kind == "shadow"
                     ? trace_any(device, prepared.tree, rays, arguments.options, progress)
                     : trace_closest(device, prepared.tree, rays, arguments.options, progress);
    }
    progress.step("counting");
    {
        const Stage stage(device, "statistics");
        result.rays = rays.size();
        result.work = count_work(device, prepared.tree, rays, arguments.options);
    }
    Json report = base_report(device, input, prepared, {"statistics"});
    if (!prepared.options.areas.empty() || !prepared.probed.empty())
        add_areas(download(device, prepared.tree), prepared, report);
    add_to_report(arguments, input, result, report);
    save_report(arguments.report, report);
    progress.clear();
    if (!arguments.common.quiet) print_summary(arguments, result);
    if (arguments.common.profile) print_profile(device, prepared);
}

} // namespace

Command add_trace(CLI::App& tool) {
    CLI::App* app = tool.add_subcommand("trace", "Trace rays through a tree and measure it");
    const auto arguments = std::make_shared<Arguments>();
    app->add_option("FILE", arguments->input, "glTF 2.0 scene, or .bxw file with its tree")->required()->type_name("");
    app->add_option(
           "--rays", arguments->rays.kind,
           "primary: closest hits of camera rays (default); diffuse: closest hits of rays that leave those "
           "hits; shadow: any hit between those hits and a light in the scene's bounding box; near: closest hits of as "
           "many rays that leave random triangles of the scene")
        ->check(CLI::IsMember({"primary", "diffuse", "shadow", "near"}));
    add_ray_options(*app, arguments->rays);
    add_intersector(*app, arguments->options);
    add_build_options(*app, arguments->choice);
    app->add_option("--report", arguments->report, "JSON report to write");
    add_common(*app, arguments->common);
    add_example(*app, "  boxwood trace forest.bxw --rays diffuse --report trace.json");
    return {app, [arguments] { run(*arguments); }};
}

} // namespace boxwood::cli
