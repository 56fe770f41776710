// SPDX-License-Identifier: MIT
// The tables that `boxwood study influence` prints.
#include <iostream>

#include "cli/study_summary.hpp"
#include "cli/table.hpp"

namespace boxwood::cli {

namespace {

std::string number(const std::optional<double>& value, int digits) { return value ? fixed(*value, digits) : "-"; }

/// "ours|published", where it was published.
std::string beside(const std::string& ours, const std::optional<double>& published, int digits) {
    return published ? ours + '|' + fixed(*published, digits) : ours;
}

std::vector<std::string> head_of(const InfluenceStudy& study, std::string first) {
    std::vector<std::string> head{std::move(first)};
    for (const StudyBuilder& builder : study.builders) head.push_back(builder.name);
    return head;
}

std::string legend(const InfluenceStudy& study) { return study.published ? " (ours|published)" : ""; }

void print_costs(const InfluenceStudy& study) {
    Table all, to_hit;
    all.add(head_of(study, "configuration"));
    std::vector<std::string> head = head_of(study, "configuration");
    head.insert(head.end(), {"triangles", "hits, %"});
    to_hit.add(std::move(head));
    for (const ConfigurationResult& result : study.results) {
        std::vector<std::string> row{result.configuration.name()}, row_to_hit = row;
        for (const StudyBuilder& builder : study.builders) {
            row.push_back(beside(number(cost(result, builder.name), 1), published_cost(result, builder.name), 1));
            row_to_hit.push_back(number(cost_to_hit(result, builder.name), 1));
        }
        row_to_hit.push_back(std::to_string(result.triangles));
        row_to_hit.push_back(result.trees.empty() ? "-" : fixed(100.0 * result.trees.begin()->second.hits, 1));
        all.add(std::move(row));
        to_hit.add(std::move(row_to_hit));
    }
    all.print("Cost of a ray over all boxes that it meets" + legend(study));
    to_hit.print("Cost of a search for the closest hit, nearest child first");
}

std::optional<double> known(const Ratios& ratios, double Ratios::*value) {
    return ratios.count ? std::optional(ratios.*value) : std::nullopt;
}

/// Published ratios beside ours where `published` is given.
void print_ratios(const InfluenceStudy& study, const Figure& figure, bool published, const std::string& title) {
    Table table;
    table.add(head_of(study, "geometric means"));
    const auto published_ratios = [&](const Group& group, const std::string& builder) {
        return published ? ratios(study.results, group, published_cost, builder, study_base) : Ratios{};
    };
    const auto add = [&](const std::string& word, const Group& group, double Ratios::*value, int digits) {
        std::vector<std::string> row{word};
        for (const StudyBuilder& builder : study.builders) {
            const Ratios ours = ratios(study.results, group, figure, builder.name, study_base);
            row.push_back(beside(number(known(ours, value), digits),
                                 known(published_ratios(group, builder.name), value), digits));
        }
        table.add(std::move(row));
    };
    for (const Group& group : groups_of(study.results)) add(group.name(), group, &Ratios::geomean, 3);
    add("worst", {}, &Ratios::worst, 3);
    std::vector<std::string> better{"better in"};
    for (const StudyBuilder& builder : study.builders) {
        const Ratios theirs = published_ratios({}, builder.name);
        const std::string ours = std::to_string(ratios(study.results, {}, figure, builder.name, study_base).better);
        better.push_back(theirs.count ? ours + '|' + std::to_string(theirs.better) : ours);
    }
    table.add(std::move(better));
    if (published) {
        std::vector<std::string> row{"over published base"};
        for (const StudyBuilder& builder : study.builders)
            row.push_back(number(
                known(ratios(study.results, {}, figure, builder.name, study_base, published_cost), &Ratios::geomean),
                3));
        table.add(std::move(row));
    }
    table.print(title);
}

void print_errors(const InfluenceStudy& study) {
    Table table;
    table.add({"", "plane", "plane", "plane", "point", "point", "point"});
    table.add({"tree by", "PAH, culled", "PAH", "SAH", "PAH, culled", "PAH", "SAH"});
    const auto percent = [](std::optional<double> value) {
        return value ? std::optional(100.0 * *value) : std::nullopt;
    };
    for (const StudyBuilder& builder : study.builders) {
        std::vector<std::string> row{builder.name};
        for (const char* area : {"plane", "point"}) {
            const auto error = [&](const Figure& figure) {
                return percent(mean(study.results, {area, ""}, figure, builder.name));
            };
            row.push_back(beside(number(error(culled_error), 1), error(published_projected_error), 1));
            row.push_back(number(error(projected_error), 1));
            row.push_back(beside(number(error(surface_error), 1), error(published_surface_error), 1));
        }
        table.add(std::move(row));
    }
    table.print("Mean error of the estimated cost, in %" + legend(study));
}

void print_overlap(const InfluenceStudy& study) {
    Table table;
    table.add({"", "down to 4", "down to 4", "7", "10", "15", "all"});
    table.add({"tree by", "all", "culled", "culled", "culled", "culled", "culled"});
    for (const StudyBuilder& builder : study.builders) {
        const auto percent = [&](const Figure& figure) {
            const auto value = mean(study.results, {}, figure, builder.name);
            return value ? std::optional(100.0 * *value) : std::nullopt;
        };
        std::vector<std::string> row{
            builder.name, beside(number(percent(overlap_to(4, false)), 1), percent(published_overlap), 1),
            beside(number(percent(overlap_to(4, true)), 1), percent(published_overlap_culled), 1)};
        for (std::size_t i = 1; i < std::size(overlap_levels); ++i)
            row.push_back(number(percent(overlap_to(overlap_levels[i], true)), 1));
        table.add(std::move(row));
    }
    table.print("Mean overlap of siblings' projections, in %" + legend(study));
}

void print_parameters(const InfluenceStudy& study) {
    if (study.cases.empty()) return;
    // The paper's table 2, over its 64 configurations.
    const double published[][3] = {
        {110.5, 1.8, 34}, {88.4, 2.4, 13}, {148.3, 1.5, 68}, {69.1, 2.0, 41}, {124.6, 1.7, 29}};
    Table table;
    table.add({"PAH+SPFH", "plane quality", "acceptable", "excellent", "cost", "axes per node", "fallback, %"});
    for (std::size_t i = 0; i < study.cases.size(); ++i) {
        const StudyBuilder& each = study.cases[i];
        const CaseFigures figures = case_figures(study, each.name);
        table.add({each.name, fixed(each.options.split_plane_quality, 1), fixed(each.options.acceptable_children, 1),
                   fixed(each.options.excellent_children, 1), beside(fixed(figures.cost, 1), published[i][0], 1),
                   beside(fixed(figures.axes_per_node, 2), published[i][1], 1),
                   beside(fixed(100.0 * figures.fallback_share, 0), published[i][2], 0)});
    }
    table.print("Parameters (ours|published, over its 64 configurations)");
}

} // namespace

void print_study(const InfluenceStudy& study) {
    print_costs(study);
    print_ratios(study, cost, study.published,
                 "Cost over all boxes, relative to " + std::string(study_base) + legend(study));
    print_ratios(study, cost_to_hit, false,
                 "Cost of a search for the closest hit, relative to " + std::string(study_base));
    print_errors(study);
    print_overlap(study);
    print_parameters(study);
    if (study.left_out.empty()) return;
    std::cout << "\nleft out, as their scenes are not at hand:";
    for (const std::string& scene : study.left_out) std::cout << ' ' << scene;
    std::cout << '\n';
}

} // namespace boxwood::cli
