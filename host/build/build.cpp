// SPDX-License-Identifier: MIT
#include "boxwood/build.hpp"

#include <chrono>
#include <type_traits>

#include "build/options.hpp"
#include "build/pipeline.hpp"
#include "metrics/overlap.hpp"
#include "metrics/quality.hpp"

namespace boxwood {

namespace {

using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;

void fill_quality(Device& device, const Tree& tree, const BuildParts& parts, bool overlap, BuildReport& report) {
    const TreeQuality quality = measure(device, parts.bottom);
    report.bottom = report.all = quality.sums;
    report.sah = quality.sah[0];
    if (tree.levels() == Levels::two) {
        const TreeQuality top = measure(device, parts.top, true);
        report.top = top.sums;
        report.all = total(quality, top);
        report.sah = two_level_sah(quality, top, download(device, tree.arrays().instances));
    }
    visit_layout(tree.arrays(), [&](const auto& bottom, const auto&) {
        if constexpr (std::is_same_v<decltype(bottom.leaves), Buffer<Triangle>>)
            if (overlap) report.overlap = end_point_overlap(device, parts.bottom, bottom.leaves);
    });
    report.max_depth = tree.max_depth();
    report.nodes = tree.node_count();
}

} // namespace

Tree build(Device& device, const Scene& scene, const BuildOptions& options, BuildReport* report) {
    const BuildOptions resolved = resolve(scene, options);
    if (scene.instances.empty()) {
        if (report) {
            *report = {};
            if (options.builder != Builder::blend) report->areas.resize(options.areas.size());
        }
        return Tree(start_tree(resolved, {}));
    }
    device.take_profile();
    device.reset_peak();
    const double compiled = device.compile_ms();
    const auto start = Clock::now();

    BuildParts parts;
    Tree tree(build_tree(device, scene, resolved, parts));
    parts.geometry = {};
    parts.local.names = {};
    parts.mesh_boxes = {};

    if (report) {
        report->compile_ms = device.compile_ms() - compiled;
        report->total_ms = Milliseconds(Clock::now() - start).count() - report->compile_ms;
        report->upload_ms = Milliseconds(parts.uploaded - start).count();
        report->profile = device.take_profile();
        report->peak_device_bytes = device.peak_bytes();
        report->areas = parts.local.reports;
        fill_quality(device, tree, parts, options.measure_overlap, *report);
    }
    return tree;
}

Tree build(Device& device, std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles,
           const BuildOptions& options, BuildReport* report) {
    Scene scene;
    Mesh& mesh = scene.meshes.emplace_back();
    mesh.positions.assign(positions.begin(), positions.end());
    mesh.triangles.assign(triangles.begin(), triangles.end());
    scene.instances.push_back({"", 0, glm::mat4(1.0f)});
    if (triangles.empty()) scene = {};
    validate(scene, "mesh");
    return build(device, scene, options, report);
}

} // namespace boxwood
