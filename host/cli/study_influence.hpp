// SPDX-License-Identifier: MIT
// The experiments of the paper's section 9 on our own builders: trees over the triangles of an influence area, and what
// its rays pay in them.
#pragma once

#include <map>
#include <span>

#include "boxwood/analysis.hpp"
#include "boxwood/topdown.hpp"
#include "cli/study_published.hpp"
#include "cli/study_scenes.hpp"

namespace boxwood::cli {

/// A way to build, by the word for it in tables and reports.
struct StudyBuilder {
    std::string name;
    TopDownOptions options;
    bool barycentres = false;   ///< Primitives go by barycentres, as in the paper, not by the centres of their boxes.
    bool costed_leaves = false; ///< Leaves by cost, in place of those of the options.
    float share = 1.0f;         ///< Of all rays, those that follow the area, as the builder is told.
};

/// The base of all ratios.
inline constexpr const char* study_base = "SAH+LSPH";

/// The paper's four builders with its parameters (8.1.1, table 1), the base first. Then what the paper lacks: surface
/// area with all axes tried at every node (sah-axes); the same with a cost of overlap and leaves by cost (sah-best);
/// and the last with the probabilities of the rays that come (blend), so that the two tell what knowing the rays is
/// worth.
std::vector<StudyBuilder> study_builders();

/// The five cases of the paper's table 2, all of PAH+SPFH.
std::vector<StudyBuilder> parameter_cases();

/// One tree and its rays; costs are means per ray.
struct TreeResult {
    double cost = 0.0;        ///< Over all boxes that the rays meet (paper 9.1).
    double cost_to_hit = 0.0; ///< Of a search for the closest hit.
    double hits = 0.0;        ///< Share of the rays.
    Analysis analysis;
    std::uint64_t splits = 0;
    std::uint64_t axes_tried = 0;
    std::uint64_t fallbacks = 0;
};

/// A configuration and the trees of all builders.
struct ConfigurationResult {
    Configuration configuration;
    std::size_t triangles = 0; ///< In the local trees.
    std::map<std::string, TreeResult> trees;
    std::map<std::string, PublishedCost> published;
};

/// Builds and measures a tree of each builder over the triangles with a point in the region, and follows the same
/// `rays` in each.
ConfigurationResult study_configuration(Device& device, const Configuration& configuration, const Mesh& scene,
                                        std::span<const StudyBuilder> builders, const std::vector<Ray>& rays);

} // namespace boxwood::cli
