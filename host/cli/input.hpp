// SPDX-License-Identifier: MIT
// From the SCENE argument to a tree on a device.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "boxwood/area_probe.hpp"
#include "boxwood/build.hpp"
#include "boxwood/scene.hpp"
#include "boxwood/tree_image.hpp"
#include "cli/command.hpp"

namespace boxwood::cli {

/// A scene, with its tree when it came from a .bxw file.
struct Input {
    std::filesystem::path file;
    Scene scene;
    std::optional<TreeImage> tree;
};

/// Reads a glTF scene or a .bxw file, told apart by their contents, and prints the warnings of the scene on standard
/// error unless `quiet`. Throws InputError.
Input load_input(const std::filesystem::path& file, bool quiet);

/// Prints warnings about `file` on standard error, the first few, a line each.
void print_warnings(const std::filesystem::path& file, const std::vector<std::string>& warnings);

/// A tree ready for rays, and what building it measured when it was built.
struct Prepared {
    Tree tree;
    BuildOptions options; ///< As asked for, the layout as it was chosen; or what a stored tree tells.
    std::optional<BuildReport> report;
    std::vector<ProbedArea> probed;    ///< With --areas lights or probe.
    std::vector<std::string> warnings; ///< rounding_warnings.
};

/// The stored tree of a .bxw file, else one built. Prints its warnings on standard error unless `quiet`. Throws
/// UsageError for build options beside a stored tree.
Prepared prepare(Device& device, const Input& input, const BuildChoice& choice, bool quiet);

/// What one level, asked for or needed by areas, loses of the scene by rounding, and what to do: one warning, or none
/// where that is no more than rounding_limit or the levels are two.
std::vector<std::string> rounding_warnings(const Scene& scene, const BuildOptions& options);

} // namespace boxwood::cli
