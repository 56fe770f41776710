// SPDX-License-Identifier: MIT
// The tables that `boxwood quality` prints.
#include <iomanip>
#include <sstream>

#include "cli/quality_report.hpp"
#include "cli/table.hpp"
#include "common/median.hpp"

namespace boxwood::cli {

namespace {

/// Sums of scenes of any size: six digits.
std::string sum(double value) {
    std::ostringstream text;
    text << std::setprecision(6) << value;
    return text.str();
}

/// "-" for the control, which has no oriented boxes.
std::string percent(const KindResult& kind, double fraction) {
    return kind.prepared.options.bounds.kind == Bounds::aabb ? "-" : fixed(100.0 * fraction, 1);
}

void print_boxes(const QualityStudy& study) {
    const BuildReport& control = *study.kinds[0].prepared.report;
    Table table;
    table.add({"kind", "volume", "/aabb", "area", "/aabb", "OBB smaller, %", "SAH cost", "near tests/ray",
               "end-point overlap"});
    for (const KindResult& kind : study.kinds) {
        const BuildReport& report = *kind.prepared.report;
        table.add({kind.key, sum(report.all.sum_volume), fixed(ratio(report.all.sum_volume, control.all.sum_volume), 4),
                   sum(report.all.sum_area), fixed(ratio(report.all.sum_area, control.all.sum_area), 4),
                   percent(kind, report.all.obb_smaller_fraction), fixed(report.sah, 2),
                   fixed(kind.near.volumes_per_ray + kind.near.primitives_per_ray, 2), fixed(report.overlap, 3)});
    }
    table.print("Boxes: sums over all nodes, in scene units; tests of rays that leave random triangles");
}

void print_levels_apart(const QualityStudy& study) {
    const BuildReport& control = *study.kinds[0].prepared.report;
    Table table;
    table.add({"", "bottom", "bottom", "bottom", "bottom", "top", "top", "top", "top"});
    table.add({"kind", "volume", "/aabb", "area/aabb", "smaller, %", "volume", "/aabb", "area/aabb", "smaller, %"});
    for (const KindResult& kind : study.kinds) {
        const BuildReport& report = *kind.prepared.report;
        std::vector<std::string> row{kind.key};
        for (const auto level : {&BuildReport::bottom, &BuildReport::top}) {
            row.push_back(sum((report.*level).sum_volume));
            row.push_back(fixed(ratio((report.*level).sum_volume, (control.*level).sum_volume), 4));
            row.push_back(fixed(ratio((report.*level).sum_area, (control.*level).sum_area), 4));
            row.push_back(percent(kind, (report.*level).obb_smaller_fraction));
        }
        table.add(std::move(row));
    }
    table.print("Levels apart: the bottom in object space, each mesh once; the top in world space");
}

void print_comparison(const QualityStudy& study, const LevelsComparison& levels) {
    const LevelQuality &one = levels.one.at("aabb").all, &two = levels.two.at("aabb").all;
    Table table;
    table.add({"", "one level", "one level", "one level", "two levels", "two levels", "two levels", "two / one"});
    table.add({"kind", "volume", "/aabb", "smaller, %", "volume", "/aabb", "smaller, %", "volume"});
    for (const KindResult& kind : study.kinds) {
        const LevelQuality &single = levels.one.at(kind.key).all, &both = levels.two.at(kind.key).all;
        table.add({kind.key, sum(single.sum_volume), fixed(ratio(single.sum_volume, one.sum_volume), 4),
                   percent(kind, single.obb_smaller_fraction), sum(both.sum_volume),
                   fixed(ratio(both.sum_volume, two.sum_volume), 4), percent(kind, both.obb_smaller_fraction),
                   fixed(ratio(both.sum_volume, single.sum_volume), 4)});
    }
    table.print("One tree over everything against a tree per mesh under a tree over instances");
}

void print_rays(const QualityStudy& study) {
    Table table;
    table.add({"", "primary", "primary", "primary", "bounce", "bounce", "bounce", "bounce volumes"});
    table.add({"kind", "volumes/ray", "triangles/ray", "Mray/s", "volumes/ray", "triangles/ray", "Mray/s", "/aabb"});
    const double control = study.kinds[0].bounce.work.volumes_per_ray;
    for (const KindResult& kind : study.kinds)
        table.add({kind.key, fixed(kind.primary.work.volumes_per_ray, 2),
                   fixed(kind.primary.work.primitives_per_ray, 2),
                   fixed(mrays_per_s(study.primary_rays, median(kind.primary.ms)), 2),
                   fixed(kind.bounce.work.volumes_per_ray, 2), fixed(kind.bounce.work.primitives_per_ray, 2),
                   fixed(mrays_per_s(study.bounce_rays, median(kind.bounce.ms)), 2),
                   fixed(ratio(kind.bounce.work.volumes_per_ray, control), 4)});
    table.print("Closest hits: " + grouped(study.primary_rays) + " primary and " + grouped(study.bounce_rays) +
                " bounce rays; median of " + std::to_string(quality_launches) + " alternating launches");
}

void print_times(const QualityStudy& study, bool two_levels) {
    Table table;
    std::vector<std::string> head{"kind",  "bounds", "morton", "sort",    "hierarchy",
                                  "AABBs", "OBBs",   "/AABBs", "collapse"};
    if (two_levels) head.push_back("top level");
    head.push_back("wall clock");
    table.add(std::move(head));
    for (const KindResult& kind : study.kinds) {
        std::vector<std::string> row{kind.key};
        for (const char* pass : {"bounds", "morton", "sort", "hierarchy", "aabb_volumes", "volumes"})
            row.push_back(fixed(kind.pass_ms(pass), 2));
        const double fit = kind.pass_ms("volumes");
        row.push_back(fixed(study.aabb_volumes_ms > 0.0 ? fit / study.aabb_volumes_ms : 0.0, 2));
        row.push_back(fixed(kind.pass_ms("collapse"), 2));
        if (two_levels) row.push_back(fixed(kind.pass_ms("top_level"), 2));
        row.push_back(fixed(kind.pass_ms("total"), 2));
        table.add(std::move(row));
    }
    table.print("Time of each pass in ms; median of " + std::to_string(quality_builds) + " alternating builds");
}

} // namespace

void print_quality(const QualityStudy& study, const LevelsComparison& levels, bool two_levels) {
    print_boxes(study);
    if (two_levels) print_levels_apart(study);
    if (!levels.empty()) print_comparison(study, levels);
    print_rays(study);
    print_times(study, two_levels);
}

} // namespace boxwood::cli
