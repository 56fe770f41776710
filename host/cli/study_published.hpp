// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace boxwood::cli {

/// What the authors measured of one builder in one configuration.
struct PublishedCost {
    double cost = 0.0; ///< Per ray, over all boxes that it meets in the local tree.
    double estimated_pah = 0.0;
    double estimated_sah = 0.0;
    double overlap = 0.0; ///< Of siblings down to level 4.
    double overlap_culled = 0.0;
};

/// By builder ("SAH+LSPH", ...), by configuration ("SCENE AREA ORIENTATION").
using Published = std::map<std::string, std::map<std::string, PublishedCost>>;

/// Reads a CSV file with a head that names its columns: scene, area, orientation, builder, real_cost_local,
/// estimated_pah_cost, estimated_sah_cost, overlap_level4, overlap_level4_culled, in any order, and others that are not
/// read. Throws InputError naming the file and the line.
Published load_published(const std::filesystem::path& file);

} // namespace boxwood::cli
