// SPDX-License-Identifier: MIT
#include <algorithm>

#include "cli/study_summary.hpp"
#include "cli/table.hpp"

namespace boxwood::cli {

namespace {

Json report_of(const TreeResult& tree) {
    Json json = {{"estimated_sah", tree.analysis.all.sah},
                 {"estimated_pah", tree.analysis.all.pah},
                 {"estimated_pah_culled", tree.analysis.all.pah_culled},
                 {"depth", tree.analysis.depth()},
                 {"nodes", tree.analysis.all.nodes},
                 {"splits", tree.splits},
                 {"axes_tried", tree.axes_tried},
                 {"fallbacks", tree.fallbacks}};
    for (const std::uint32_t level : overlap_levels) {
        const LevelFigures figures = tree.analysis.down_to(level);
        json["overlap"][level_word(level)] = figures.overlap_ratio();
        json["overlap_culled"][level_word(level)] = figures.overlap_ratio_culled();
    }
    return json;
}

Json report_of(const ConfigurationResult& result) {
    const Configuration& configuration = result.configuration;
    Json json = {{"scene", configuration.scene},
                 {"area", configuration.area},
                 {"orientation", configuration.orientation},
                 {"triangles", result.triangles}};
    json["hits"] = result.trees.empty() ? 0.0 : result.trees.begin()->second.hits;
    for (const char* key : {"costs", "costs_to_hit", "published", "trees"}) json[key] = Json::object();
    for (const auto& [builder, tree] : result.trees) {
        json["costs"][builder] = tree.cost;
        json["costs_to_hit"][builder] = tree.cost_to_hit;
        json["trees"][builder] = report_of(tree);
    }
    for (const auto& [builder, published] : result.published) json["published"][builder] = published.cost;
    return json;
}

/// Ratios of all builders that have the figure.
struct Columns {
    Json geomean = Json::object();
    Json worst = Json::object();
    Json better = Json::object();
};

Columns columns(const InfluenceStudy& study, const Group& group, const Figure& figure, const Figure& base_figure = {}) {
    Columns json;
    for (const StudyBuilder& builder : study.builders) {
        const Ratios found = ratios(study.results, group, figure, builder.name, study_base, base_figure);
        if (!found.count) continue;
        json.geomean[builder.name] = found.geomean;
        json.worst[builder.name] = found.worst;
        json.better[builder.name] = found.better;
    }
    return json;
}

std::size_t count_of(std::span<const ConfigurationResult> results, const Group& group) {
    return static_cast<std::size_t>(
        std::ranges::count_if(results, [&](const ConfigurationResult& result) { return group.has(result); }));
}

void add_ratios(const InfluenceStudy& study, Json& report) {
    const Columns all = columns(study, {}, cost), to_hit = columns(study, {}, cost_to_hit),
                  published = columns(study, {}, published_cost);
    report["geomean"] = all.geomean;
    report["worst"] = all.worst;
    report["better_in"] = all.better;
    report["geomean_to_hit"] = to_hit.geomean;
    report["worst_to_hit"] = to_hit.worst;
    report["better_in_to_hit"] = to_hit.better;
    report["published_geomean"] = published.geomean;
    report["published_better_in"] = published.better;
    report["geomean_over_published"] = columns(study, {}, cost, published_cost).geomean;
    report["groups"] = Json::object();
    for (const Group& group : groups_of(study.results))
        report["groups"][group.name()] = {{"configurations", count_of(study.results, group)},
                                          {"geomean", columns(study, group, cost).geomean},
                                          {"geomean_to_hit", columns(study, group, cost_to_hit).geomean},
                                          {"published_geomean", columns(study, group, published_cost).geomean}};
}

void add_mean(const InfluenceStudy& study, const Group& group, const Figure& figure, const std::string& builder,
              const char* key, Json& json) {
    if (const auto value = mean(study.results, group, figure, builder)) json[key] = *value;
}

void add_errors(const InfluenceStudy& study, Json& report) {
    for (const char* area : {"plane", "point"}) {
        const Group group{area, ""};
        for (const StudyBuilder& builder : study.builders) {
            Json& json = report["errors"][area][builder.name] = Json::object();
            add_mean(study, group, culled_error, builder.name, "pah_culled", json);
            add_mean(study, group, projected_error, builder.name, "pah", json);
            add_mean(study, group, surface_error, builder.name, "sah", json);
            add_mean(study, group, published_projected_error, builder.name, "published_pah", json);
            add_mean(study, group, published_surface_error, builder.name, "published_sah", json);
        }
    }
}

void add_overlap(const InfluenceStudy& study, Json& report) {
    report["published_overlap"] = Json::object();
    for (const StudyBuilder& builder : study.builders) {
        for (const std::uint32_t level : overlap_levels) {
            Json& json = report["overlap"][builder.name][level_word(level)] = Json::object();
            add_mean(study, {}, overlap_to(level, false), builder.name, "all", json);
            add_mean(study, {}, overlap_to(level, true), builder.name, "culled", json);
        }
        if (!mean(study.results, {}, published_overlap, builder.name)) continue;
        Json& json = report["published_overlap"][builder.name];
        add_mean(study, {}, published_overlap, builder.name, "all", json);
        add_mean(study, {}, published_overlap_culled, builder.name, "culled", json);
    }
}

void add_parameters(const InfluenceStudy& study, Json& report) {
    if (study.cases.empty()) return;
    for (const StudyBuilder& each : study.cases) {
        const CaseFigures figures = case_figures(study, each.name);
        report["parameters"].push_back({{"split_plane_quality", each.options.split_plane_quality},
                                        {"acceptable_children", each.options.acceptable_children},
                                        {"excellent_children", each.options.excellent_children},
                                        {"cost", figures.cost},
                                        {"axes_per_node", figures.axes_per_node},
                                        {"fallback_share", figures.fallback_share}});
    }
}

} // namespace

void add_study(const InfluenceStudy& study, Json& report) {
    report["configurations"] = Json::array();
    for (const ConfigurationResult& result : study.results) report["configurations"].push_back(report_of(result));
    add_ratios(study, report);
    add_errors(study, report);
    add_overlap(study, report);
    add_parameters(study, report);
    report["left_out"] = study.left_out;
}

} // namespace boxwood::cli
