// SPDX-License-Identifier: MIT
// Reports for scripts: JSON with the same keys from every command.
#pragma once

#include <filesystem>

#include <nlohmann/json.hpp>

#include "boxwood/device.hpp"
#include "cli/input.hpp"

namespace boxwood::cli {

using Json = nlohmann::ordered_json;

/// "boxwood", "device", "scene", "options", "requirements", "passes_ms", "compile_ms", "peak_device_bytes", "quality".
/// From a stored tree "passes_ms" has only a total of 0, and "quality" only what can be read off the tree.
/// `query` words, such as "statistics", are added to the requirements.
Json base_report(const Device& device, const Input& input, const Prepared& prepared,
                 const std::vector<std::string>& query);

/// "platform", "name", "driver", "language", and whether the arithmetic is that of every other such device:
/// "denormals", "correctly_rounded_divide_sqrt".
Json device_report(const DeviceInfo& info);

/// Counts of a scene: "file", "meshes", "instances", "triangles", "vertices", "dropped_triangles", ...
Json scene_report(const Input& input);

/// "sum_volume", "sum_area", "obb_smaller_fraction".
Json level_report(const LevelQuality& level);

/// Nodes of the layout.
std::size_t bottom_nodes(const TreeImage& tree);
std::size_t top_nodes(const TreeImage& tree);

/// Writes the report, indented; nothing for an empty path. Throws InputError.
void save_report(const std::filesystem::path& file, const Json& report);

/// Prints the device times of the build, if there was one, and of all since as a table on standard output. Waits.
void print_profile(Device& device, const Prepared& prepared);
/// The same, the times since having been taken already.
void print_profile(const Prepared& prepared, const Profile& since);

/// 1234567 as "1,234,567".
std::string grouped(std::uint64_t number);

} // namespace boxwood::cli
