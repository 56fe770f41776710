// SPDX-License-Identifier: MIT
// What the influence study is about: the paper's configurations, their scenes, triangles and rays (shared by its
// authors).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "boxwood/device.hpp"
#include "boxwood/influence.hpp"
#include "boxwood/scene.hpp"
#include "shared/ray.h"

namespace boxwood::cli {

/// One influence area in one scene.
struct Configuration {
    std::string scene;
    std::string area;        ///< "plane" or "point".
    std::string orientation; ///< "parallel", "15", "45" or "oblique".
    InfluenceRecord record;

    std::string name() const { return scene + ' ' + area + ' ' + orientation; }
};

/// Reads the file of load_areas, whose entries also have "scene" and "orientation". Throws InputError naming the file
/// and the entry.
std::vector<Configuration> load_configurations(const std::filesystem::path& file);

/// A scene as one mesh in world space: made (Random100, Random1000), or folder/pah_NAME.glb, where Suzanne is
/// MonkeyModel and Wood is WoodScene. Nothing when there is no such file.
std::optional<Mesh> load_study_scene(const std::string& name, const std::filesystem::path& folder, std::uint64_t seed);

/// The triangles of `mesh` with a point in the region of `area`; an empty mesh when there are none.
Mesh local_mesh(Device& device, const Mesh& mesh, const InfluenceRecord& area);

/// Rays that leave the area's rectangle uniformly, along the area's rays, without an end.
std::vector<Ray> area_rays(const InfluenceRecord& area, std::uint32_t count, std::uint64_t seed);

} // namespace boxwood::cli
