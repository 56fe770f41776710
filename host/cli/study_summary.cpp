// SPDX-License-Identifier: MIT
#include "cli/study_summary.hpp"

#include <algorithm>
#include <cmath>

namespace boxwood::cli {

namespace {

const TreeResult* tree_of(const ConfigurationResult& result, const std::string& builder) {
    const auto found = result.trees.find(builder);
    return found == result.trees.end() ? nullptr : &found->second;
}

const PublishedCost* published_of(const ConfigurationResult& result, const std::string& builder) {
    const auto found = result.published.find(builder);
    return found == result.published.end() ? nullptr : &found->second;
}

std::optional<double> error_of(double real, double estimate) {
    if (!(estimate > 0.0)) return std::nullopt;
    return std::abs(real - estimate) / estimate;
}

} // namespace

std::string Group::name() const {
    if (area.empty()) return "all";
    return orientation.empty() ? area : area + ' ' + orientation;
}

bool Group::has(const ConfigurationResult& result) const {
    const Configuration& configuration = result.configuration;
    return (area.empty() || area == configuration.area) &&
           (orientation.empty() || orientation == configuration.orientation);
}

std::vector<Group> groups_of(std::span<const ConfigurationResult> results) {
    // As in the paper's charts; words of the user's own come behind.
    std::vector<std::string> orientations{"parallel", "15", "45", "oblique"};
    for (const ConfigurationResult& result : results) {
        const std::string& word = result.configuration.orientation;
        if (std::ranges::find(orientations, word) == orientations.end()) orientations.push_back(word);
    }
    std::vector<Group> groups;
    for (const char* area : {"plane", "point"})
        for (const std::string& orientation : orientations) {
            const Group group{area, orientation};
            if (std::ranges::any_of(results, [&](const auto& each) { return group.has(each); }))
                groups.push_back(group);
        }
    groups.push_back({});
    return groups;
}

std::optional<double> cost(const ConfigurationResult& result, const std::string& builder) {
    const TreeResult* tree = tree_of(result, builder);
    return tree ? std::optional(tree->cost) : std::nullopt;
}

std::optional<double> cost_to_hit(const ConfigurationResult& result, const std::string& builder) {
    const TreeResult* tree = tree_of(result, builder);
    return tree ? std::optional(tree->cost_to_hit) : std::nullopt;
}

std::optional<double> published_cost(const ConfigurationResult& result, const std::string& builder) {
    const PublishedCost* published = published_of(result, builder);
    return published ? std::optional(published->cost) : std::nullopt;
}

Ratios ratios(std::span<const ConfigurationResult> results, const Group& group, const Figure& figure,
              const std::string& builder, const std::string& base, const Figure& base_figure) {
    Ratios ratios;
    double logarithms = 0.0;
    for (const ConfigurationResult& result : results) {
        const std::optional<double> value = figure(result, builder);
        const std::optional<double> unit = base_figure ? base_figure(result, base) : figure(result, base);
        if (!group.has(result) || !value || !unit || !(*value > 0.0 && *unit > 0.0)) continue;
        const double ratio = *value / *unit;
        ++ratios.count;
        logarithms += std::log(ratio);
        ratios.worst = std::max(ratios.worst, ratio);
        ratios.better += ratio < 1.0 ? 1 : 0;
    }
    if (ratios.count) ratios.geomean = std::exp(logarithms / static_cast<double>(ratios.count));
    return ratios;
}

std::optional<double> mean(std::span<const ConfigurationResult> results, const Group& group, const Figure& figure,
                           const std::string& builder) {
    double sum = 0.0;
    std::size_t count = 0;
    for (const ConfigurationResult& result : results) {
        const std::optional<double> value = group.has(result) ? figure(result, builder) : std::nullopt;
        if (!value) continue;
        sum += *value;
        ++count;
    }
    return count ? std::optional(sum / static_cast<double>(count)) : std::nullopt;
}

std::optional<double> culled_error(const ConfigurationResult& result, const std::string& builder) {
    const TreeResult* tree = tree_of(result, builder);
    return tree ? error_of(tree->cost, tree->analysis.all.pah_culled) : std::nullopt;
}

std::optional<double> projected_error(const ConfigurationResult& result, const std::string& builder) {
    const TreeResult* tree = tree_of(result, builder);
    return tree ? error_of(tree->cost, tree->analysis.all.pah) : std::nullopt;
}

std::optional<double> surface_error(const ConfigurationResult& result, const std::string& builder) {
    const TreeResult* tree = tree_of(result, builder);
    return tree ? error_of(tree->cost, tree->analysis.all.sah) : std::nullopt;
}

std::optional<double> published_projected_error(const ConfigurationResult& result, const std::string& builder) {
    const PublishedCost* published = published_of(result, builder);
    return published ? error_of(published->cost, published->estimated_pah) : std::nullopt;
}

std::optional<double> published_surface_error(const ConfigurationResult& result, const std::string& builder) {
    const PublishedCost* published = published_of(result, builder);
    return published ? error_of(published->cost, published->estimated_sah) : std::nullopt;
}

Figure overlap_to(std::uint32_t level, bool culled) {
    return [=](const ConfigurationResult& result, const std::string& builder) -> std::optional<double> {
        const TreeResult* tree = tree_of(result, builder);
        if (!tree) return std::nullopt;
        const LevelFigures figures = tree->analysis.down_to(level);
        return culled ? figures.overlap_ratio_culled() : figures.overlap_ratio();
    };
}

std::optional<double> published_overlap(const ConfigurationResult& result, const std::string& builder) {
    const PublishedCost* published = published_of(result, builder);
    return published ? std::optional(published->overlap) : std::nullopt;
}

std::optional<double> published_overlap_culled(const ConfigurationResult& result, const std::string& builder) {
    const PublishedCost* published = published_of(result, builder);
    return published ? std::optional(published->overlap_culled) : std::nullopt;
}

CaseFigures case_figures(const InfluenceStudy& study, const std::string& name) {
    const auto per_split = [](std::uint64_t TreeResult::*count) {
        return [count](const ConfigurationResult& result, const std::string& builder) -> std::optional<double> {
            const TreeResult* tree = tree_of(result, builder);
            if (!tree || tree->splits == 0) return std::nullopt;
            return static_cast<double>(tree->*count) / static_cast<double>(tree->splits);
        };
    };
    const auto mean_of = [&](const Figure& figure) { return mean(study.case_results, {}, figure, name).value_or(0.0); };
    CaseFigures figures;
    figures.cost = mean_of(cost);
    figures.axes_per_node = mean_of(per_split(&TreeResult::axes_tried));
    figures.fallback_share = mean_of(per_split(&TreeResult::fallbacks));
    return figures;
}

} // namespace boxwood::cli
