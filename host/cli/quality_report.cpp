// SPDX-License-Identifier: MIT
#include "cli/quality_report.hpp"

#include "common/median.hpp"

namespace boxwood::cli {

namespace {

Json rays_report(const RayCost& cost, std::size_t rays) {
    return {{"rays", rays},
            {"volumes_per_ray", cost.work.volumes_per_ray},
            {"primitives_per_ray", cost.work.primitives_per_ray},
            {"mrays_per_s", mrays_per_s(rays, median(cost.ms))}};
}

Json kind_report(const QualityStudy& study, const KindResult& kind) {
    const BuildReport& report = *kind.prepared.report;
    const LevelQuality& control = study.kinds[0].prepared.report->all;
    Json json = level_report(report.all);
    json["volume_ratio"] = ratio(report.all.sum_volume, control.sum_volume);
    json["area_ratio"] = ratio(report.all.sum_area, control.sum_area);
    json["bottom"] = level_report(report.bottom);
    json["top"] = level_report(report.top);
    json["sah"] = report.sah;
    json["end_point_overlap"] = report.overlap;
    json["max_depth"] = report.max_depth;
    json["nodes"] = report.nodes;
    json["peak_device_bytes"] = report.peak_device_bytes;
    const Json bounce = rays_report(kind.bounce, study.bounce_rays);
    for (const char* key : {"volumes_per_ray", "primitives_per_ray", "mrays_per_s"}) json[key] = bounce[key];
    json["primary"] = rays_report(kind.primary, study.primary_rays);
    json["bounce"] = bounce;
    json["near"] = {{"rays", study.near_rays},
                    {"volumes_per_ray", kind.near.volumes_per_ray},
                    {"primitives_per_ray", kind.near.primitives_per_ray}};
    for (const char* pass : quality_passes) json["passes_ms"][pass] = kind.pass_ms(pass);
    json["fit_ratio"] = study.aabb_volumes_ms > 0.0 ? kind.pass_ms("volumes") / study.aabb_volumes_ms : 0.0;
    return json;
}

Json levels_report(const std::map<std::string, BuildReport>& reports) {
    Json json = Json::object();
    for (const auto& [key, report] : reports)
        json[key] = {{"all", level_report(report.all)},
                     {"bottom", level_report(report.bottom)},
                     {"top", level_report(report.top)}};
    return json;
}

} // namespace

double ratio(double a, double b) { return b > 0.0 ? a / b : 1.0; }

void add_quality(const QualityStudy& study, const LevelsComparison& levels, Json& report) {
    Json keys = Json::array();
    for (const KindResult& kind : study.kinds) {
        keys.push_back(kind.key);
        report["kinds"][kind.key] = kind_report(study, kind);
    }
    report["options"]["bounds"] = keys;
    report["options"]["timed_builds"] = quality_builds;
    report["options"]["timed_launches"] = quality_launches;
    if (!levels.empty()) report["levels"] = {{"one", levels_report(levels.one)}, {"two", levels_report(levels.two)}};
}

} // namespace boxwood::cli
