// SPDX-License-Identifier: MIT
// What the configurations of an influence study say together.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cli/report.hpp"
#include "cli/study_influence.hpp"

namespace boxwood::cli {

/// All that was studied.
struct InfluenceStudy {
    std::vector<StudyBuilder> builders;
    std::vector<ConfigurationResult> results;
    std::vector<StudyBuilder> cases;               ///< Of the parameter study, where asked for.
    std::vector<ConfigurationResult> case_results; ///< Trees by case.
    std::vector<std::string> left_out;             ///< Scenes that are not at hand.
    bool published = false;
};

/// Some of the configurations: those of an area kind and an orientation, of any where the word is empty.
struct Group {
    std::string area;
    std::string orientation;

    std::string name() const;
    bool has(const ConfigurationResult& result) const;
};

/// The groups that have configurations in the order of the paper's charts, then all.
std::vector<Group> groups_of(std::span<const ConfigurationResult> results);

/// Ratios of costs over several configurations.
struct Ratios {
    std::size_t count = 0;
    double geomean = 1.0;
    double worst = 0.0;
    std::size_t better = 0; ///< Below 1.
};

/// A figure of a builder in a configuration, when there is one.
using Figure = std::function<std::optional<double>(const ConfigurationResult&, const std::string& builder)>;

std::optional<double> cost(const ConfigurationResult& result, const std::string& builder);
std::optional<double> cost_to_hit(const ConfigurationResult& result, const std::string& builder);
std::optional<double> published_cost(const ConfigurationResult& result, const std::string& builder);

/// The figures of `builder` over those of `base`, by `base_figure` where that is given, where both are known and not
/// zero.
Ratios ratios(std::span<const ConfigurationResult> results, const Group& group, const Figure& figure,
              const std::string& builder, const std::string& base, const Figure& base_figure = {});

/// The mean of a figure over the configurations that have it; nothing when none has.
std::optional<double> mean(std::span<const ConfigurationResult> results, const Group& group, const Figure& figure,
                           const std::string& builder);

/// |cost - estimate| / estimate of the projected area heuristic, culled or not, and of the surface area heuristic; and
/// the same of what was published, whose estimates by projected area are not culled.
std::optional<double> culled_error(const ConfigurationResult& result, const std::string& builder);
std::optional<double> projected_error(const ConfigurationResult& result, const std::string& builder);
std::optional<double> surface_error(const ConfigurationResult& result, const std::string& builder);
std::optional<double> published_projected_error(const ConfigurationResult& result, const std::string& builder);
std::optional<double> published_surface_error(const ConfigurationResult& result, const std::string& builder);

/// Prints the tables on standard output.
void print_study(const InfluenceStudy& study);

/// Adds to a report:
///
///     "configurations": [{"scene", "area", "orientation", "triangles", "hits", "costs": {BUILDER: X},
///                         "costs_to_hit": {BUILDER: X}, "published": {BUILDER: X},
///                         "trees": {BUILDER: {"estimated_sah", "estimated_pah", "estimated_pah_culled",
///                                             "overlap": {LEVEL: X}, "overlap_culled": {LEVEL: X}, "depth", "nodes",
///                                             "splits", "axes_tried", "fallbacks"}}}]
///     "geomean", "worst", "better_in", "geomean_to_hit", "worst_to_hit", "better_in_to_hit", "published_geomean",
///     "published_better_in": {BUILDER: X}    of ratios to SAH+LSPH
///     "geomean_over_published": {BUILDER: X} of our costs over the published ones of SAH+LSPH
///     "groups": {GROUP: {"configurations", "geomean", "geomean_to_hit", "published_geomean"}}
///     "errors": {"plane" | "point": {BUILDER: {"pah_culled", "pah", "sah", "published_pah", "published_sah"}}}
///     "overlap": {BUILDER: {LEVEL: {"all", "culled"}}}, "published_overlap": {BUILDER: {"all", "culled"}}
///     "parameters": [{"split_plane_quality", "acceptable_children", "excellent_children", "cost", "axes_per_node",
///                     "fallback_share"}]
///     "left_out": [SCENE]
void add_study(const InfluenceStudy& study, Json& report);

/// Of one tree down to a level.
Figure overlap_to(std::uint32_t level, bool culled);
std::optional<double> published_overlap(const ConfigurationResult& result, const std::string& builder);
std::optional<double> published_overlap_culled(const ConfigurationResult& result, const std::string& builder);

/// Means over the trees of a case, of axes and fallbacks per split node.
struct CaseFigures {
    double cost = 0.0;
    double axes_per_node = 0.0;
    double fallback_share = 0.0;
};
CaseFigures case_figures(const InfluenceStudy& study, const std::string& name);

} // namespace boxwood::cli
