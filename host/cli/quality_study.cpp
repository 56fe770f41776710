// SPDX-License-Identifier: MIT
#include "cli/quality_study.hpp"

#include <algorithm>

#include "common/median.hpp"

namespace boxwood::cli {

namespace {

bool is_aabb_pass(const PassTime& pass) { return pass.label == "node boxes" || pass.label == "unused slots"; }

void add_times(const BuildReport& report, KindResult& kind) {
    std::map<std::string, double> times;
    for (const PassTime& pass : report.profile.passes)
        times[pass.stage == "volumes" && is_aabb_pass(pass) ? "aabb_volumes" : pass.stage] += pass.ms;
    times["total"] = report.total_ms;
    for (const char* pass : quality_passes) kind.passes[pass].push_back(times[pass]);
}

KindResult new_kind(const QualityChoice& choice, Bounds bounds, Extents extents, std::string key) {
    KindResult kind;
    kind.key = std::move(key);
    BuildOptions& options = kind.prepared.options;
    options = choice.options;
    options.layout = Layout::binary;
    options.bounds.kind = bounds;
    options.bounds.extents = extents;
    return kind;
}

void build_first(Device& device, const Scene& scene, KindResult& kind) {
    BuildOptions options = kind.prepared.options;
    options.measure_overlap = true;
    kind.prepared.report.emplace();
    kind.prepared.tree = build(device, scene, options, &*kind.prepared.report);
}

void time_builds(Device& device, const Scene& scene, std::vector<KindResult>& kinds, Progress& progress) {
    for (std::size_t run = 0; run < quality_builds; ++run) {
        progress.step("timing builds");
        for (KindResult& kind : kinds) {
            BuildReport report;
            build(device, scene, kind.prepared.options, &report);
            add_times(report, kind);
        }
    }
}

/// Counts first: that also compiles nothing that is timed, so one more launch goes before the timed ones.
void trace_kinds(Device& device, std::vector<KindResult>& kinds, const Buffer<Ray>& rays, RayCost KindResult::*cost,
                 Progress& progress) {
    Buffer<Hit> hits = make_buffer<Hit>(device, rays.size(), "hits");
    progress.step("counting");
    for (KindResult& kind : kinds) {
        (kind.*cost).work = count_work(device, kind.prepared.tree, rays);
        closest_hit(device, kind.prepared.tree, rays, hits);
    }
    for (std::size_t run = 0; run < quality_launches; ++run) {
        progress.step("tracing");
        for (KindResult& kind : kinds)
            (kind.*cost).ms.push_back(timed_ms(device, [&] { closest_hit(device, kind.prepared.tree, rays, hits); }));
    }
}

} // namespace

double KindResult::pass_ms(const std::string& pass) const {
    const auto found = passes.find(pass);
    return found == passes.end() ? 0.0 : median(found->second);
}

std::vector<KindResult> kinds_of(const QualityChoice& choice) {
    const auto wanted = [&](std::string_view word) {
        return std::ranges::any_of(choice.words,
                                   [&](const std::string& each) { return each == "all" || each == word; });
    };
    std::vector<KindResult> kinds;
    for (const Bounds bounds : all_bounds()) {
        const std::string word(name(bounds));
        if (bounds != Bounds::aabb && !wanted(word)) continue;
        const bool corners = bounds == Bounds::obb_moments && choice.options.bounds.extents == Extents::corners;
        if (!corners) kinds.push_back(new_kind(choice, bounds, Extents::exact, word));
        if (corners || (bounds == Bounds::obb_moments && !choice.extents_given))
            kinds.push_back(new_kind(choice, bounds, Extents::corners, word + "-corners"));
    }
    return kinds;
}

std::size_t study_steps(std::size_t kinds) { return kinds + quality_builds + 2 * (1 + quality_launches) + 1; }

QualityStudy study_quality(Device& device, const Input& input, const QualityChoice& choice, Progress& progress) {
    QualityStudy study;
    study.kinds = kinds_of(choice);
    for (KindResult& kind : study.kinds) {
        progress.step("measuring " + kind.key);
        build_first(device, input.scene, kind);
    }
    time_builds(device, input.scene, study.kinds, progress);
    std::vector<double> aabb_volumes;
    for (KindResult& kind : study.kinds)
        for (const double ms : kind.passes["aabb_volumes"]) aabb_volumes.push_back(ms);
    study.aabb_volumes_ms = median(aabb_volumes);

    const Tree& control = study.kinds[0].prepared.tree;
    RayChoice rays = choice.rays;
    rays.kind = "primary";
    {
        Buffer<Ray> primary = make_rays(device, input, control, rays);
        study.primary_rays = primary.size();
        trace_kinds(device, study.kinds, primary, &KindResult::primary, progress);
    }
    rays.kind = "diffuse";
    Buffer<Ray> bounce = make_rays(device, input, control, rays);
    study.bounce_rays = bounce.size();
    trace_kinds(device, study.kinds, bounce, &KindResult::bounce, progress);
    rays.kind = "near";
    Buffer<Ray> near = make_rays(device, input, control, rays);
    study.near_rays = near.size();
    progress.step("counting");
    for (KindResult& kind : study.kinds) kind.near = count_work(device, kind.prepared.tree, near);
    return study;
}

std::map<std::string, BuildReport> measure_levels(Device& device, const Scene& scene, const QualityChoice& choice,
                                                  Levels levels, Progress& progress) {
    std::map<std::string, BuildReport> reports;
    try {
        for (const KindResult& kind : kinds_of(choice)) {
            progress.step("comparing levels: " + kind.key);
            BuildOptions options = kind.prepared.options;
            options.levels = levels;
            build(device, scene, options, &reports[kind.key]);
        }
    } catch (const CapacityError&) {
        reports.clear();
    }
    return reports;
}

} // namespace boxwood::cli
