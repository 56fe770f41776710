// SPDX-License-Identifier: MIT
#include "cli/report.hpp"

#include <algorithm>
#include <iomanip>
#include <iostream>

#include "boxwood/profile.hpp"
#include "boxwood/requirements.hpp"
#include "io/atomic_file.hpp"

namespace boxwood::cli {

namespace {

Json passes_report(const Prepared& prepared) {
    Json passes = Json::object();
    if (prepared.report) {
        for (const char* stage : {"bounds", "morton", "sort", "hierarchy", "volumes", "collapse", "top_level"})
            passes[stage] = 0.0;
        for (const PassTime& pass : prepared.report->profile.passes) {
            Json& stage = passes[pass.stage];
            stage = (stage.is_null() ? 0.0 : stage.get<double>()) + pass.ms;
        }
    }
    passes["total"] = prepared.report ? prepared.report->total_ms : 0.0;
    return passes;
}

Json quality_report(const Input& input, const Prepared& prepared) {
    if (prepared.report) {
        const BuildReport& report = *prepared.report;
        return {{"sah", report.sah},
                {"sum_volume", report.all.sum_volume},
                {"sum_area", report.all.sum_area},
                {"obb_smaller_fraction", report.all.obb_smaller_fraction},
                {"max_depth", report.max_depth},
                {"nodes", report.nodes},
                {"bottom", level_report(report.bottom)},
                {"top", level_report(report.top)}};
    }
    const TreeImage& tree = *input.tree;
    return {{"max_depth", tree.bottom_depth + tree.top_depth}, {"nodes", bottom_nodes(tree) + top_nodes(tree)}};
}

} // namespace

std::size_t bottom_nodes(const TreeImage& tree) {
    return tree.binary_nodes.size() + tree.oriented_nodes.size() + tree.wide_nodes.size();
}

std::size_t top_nodes(const TreeImage& tree) {
    return tree.binary_top.size() + tree.oriented_top.size() + tree.wide_top.size();
}

Json level_report(const LevelQuality& level) {
    return {{"sum_volume", level.sum_volume},
            {"sum_area", level.sum_area},
            {"obb_smaller_fraction", level.obb_smaller_fraction}};
}

Json device_report(const DeviceInfo& info) {
    return {{"platform", info.platform},   {"name", info.name},
            {"driver", info.driver},       {"language", info.language},
            {"denormals", info.denormals}, {"correctly_rounded_divide_sqrt", info.correctly_rounded_divide_sqrt}};
}

Json scene_report(const Input& input) {
    const Scene& scene = input.scene;
    return {{"file", input.file.string()},
            {"meshes", scene.meshes.size()},
            {"instances", scene.instances.size()},
            {"triangles", scene.triangle_count()},
            {"vertices", scene.vertex_count()},
            {"instanced_triangles", scene.instanced_triangle_count()},
            {"cameras", scene.cameras.size()},
            {"materials", scene.materials.size()},
            {"textures", scene.textures.size()},
            {"images", scene.images.size()},
            {"lights", scene.lights.size()},
            {"dropped_triangles", scene.counts.dropped_triangles},
            {"dropped_instances", scene.counts.dropped_instances},
            {"skipped_points_and_lines", scene.counts.skipped_points_and_lines},
            {"warnings", scene.warnings}};
}

Json base_report(const Device& device, const Input& input, const Prepared& prepared,
                 const std::vector<std::string>& query) {
    Json options = {{"levels", name(prepared.options.levels)},
                    {"layout", name(prepared.options.layout)},
                    {"bounds", name(prepared.options.bounds.kind)}};
    if (prepared.report) {
        options["extents"] = name(prepared.options.bounds.extents);
        options["measure"] = name(prepared.options.bounds.measure);
        options["builder"] = name(prepared.options.builder);
        options["morton"] = static_cast<int>(prepared.options.morton);
    }
    std::vector<std::string> requirement_words = words(requirements(input.scene, prepared.options));
    requirement_words.insert(requirement_words.end(), query.begin(), query.end());
    Json scene = scene_report(input);
    for (const std::string& warning : prepared.warnings) scene["warnings"].push_back(warning);
    const std::uint64_t build_peak = prepared.report ? prepared.report->peak_device_bytes : 0;
    return {{"boxwood", BOXWOOD_VERSION},
            {"device", device_report(device.info())},
            {"scene", std::move(scene)},
            {"options", std::move(options)},
            {"requirements", std::move(requirement_words)},
            {"passes_ms", passes_report(prepared)},
            {"compile_ms", device.compile_ms()},
            {"peak_device_bytes", std::max(build_peak, device.peak_bytes())},
            {"quality", quality_report(input, prepared)}};
}

void save_report(const std::filesystem::path& file, const Json& report) {
    if (file.empty()) return;
    AtomicFile output(file);
    // Names from a scene need not be valid UTF-8.
    output.stream() << report.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
    output.commit();
}

void print_profile(Device& device, const Prepared& prepared) { print_profile(prepared, device.take_profile()); }

void print_profile(const Prepared& prepared, const Profile& since) {
    Profile profile = prepared.report ? prepared.report->profile : Profile{};
    profile.passes.insert(profile.passes.end(), since.passes.begin(), since.passes.end());

    std::size_t stage_width = 5, label_width = 4;
    for (const PassTime& pass : profile.passes) {
        stage_width = std::max(stage_width, pass.stage.size());
        label_width = std::max(label_width, pass.label.size());
    }
    const auto row = [&](const std::string& stage, const std::string& label) -> std::ostream& {
        return std::cout << std::left << std::setw(static_cast<int>(stage_width)) << stage << "  "
                         << std::setw(static_cast<int>(label_width)) << label << "  " << std::right;
    };
    row("stage", "pass") << "launches          ms\n" << std::fixed << std::setprecision(3);
    for (const PassTime& pass : profile.passes)
        row(pass.stage, pass.label) << std::setw(8) << pass.launches << std::setw(12) << pass.ms << '\n';
    row("total", "") << std::setw(20) << profile.total_ms() << '\n';
}

std::string grouped(std::uint64_t number) {
    std::string digits = std::to_string(number);
    for (std::ptrdiff_t place = static_cast<std::ptrdiff_t>(digits.size()) - 3; place > 0; place -= 3)
        digits.insert(static_cast<std::size_t>(place), ",");
    return digits;
}

} // namespace boxwood::cli
