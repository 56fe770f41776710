// SPDX-License-Identifier: MIT
#include "boxwood/build.hpp"

#include <chrono>

#include "hierarchy/overlap.hpp"
#include "hierarchy/placed_build.hpp"
#include "hierarchy/quality.hpp"

namespace boxwood {

namespace {

using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;

void fill_quality(Device& device, const Tree& tree, const BuildParts& parts, bool overlap, BuildReport& report) {
    const ForestQuality bottom = measure(device, parts.bottom);
    report.bottom = report.all = bottom.sums;
    report.sah = bottom.sah[0];
    if (tree.levels == Levels::two) {
        const ForestQuality top = measure(device, parts.top, true);
        report.top = top.sums;
        report.all = total(bottom, top);
        report.sah = two_level_sah(bottom, top, download(device, tree.instances));
    }
    if (overlap && tree.layout == Layout::binary)
        report.overlap = end_point_overlap(device, parts.bottom, tree.triangles);
    report.max_depth = tree.bottom_depth + tree.top_depth;
    report.nodes = tree.wide_nodes.size() + tree.wide_top.size() + tree.binary_nodes.size() + tree.binary_top.size() +
                   tree.oriented_nodes.size() + tree.oriented_top.size();
}

} // namespace

Tree build(Device& device, const Scene& scene, const BuildOptions& options, BuildReport* report) {
    Tree tree = empty_tree(options);
    if (scene.instances.empty()) {
        if (report) {
            *report = {};
            if (options.builder != Builder::blend) report->areas.resize(options.areas.size());
        }
        return tree;
    }
    device.take_profile();
    device.reset_peak();
    const double compiled = device.compile_ms();
    const auto start = Clock::now();

    BuildParts parts;
    tree = build_tree(device, scene, options, parts);
    parts.geometry = {};
    parts.local.names = {};
    parts.mesh_boxes = {};
    add_instance_lookup(device, scene, tree);

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

} // namespace boxwood
