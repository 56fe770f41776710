// SPDX-License-Identifier: MIT
// Where a command looks from.
#pragma once

#include <optional>
#include <string>

#include "cli/command.hpp"
#include "cli/input.hpp"

namespace boxwood::cli {

/// A camera of the file by name or index, or a place of one's own.
struct View {
    std::string camera;
    std::optional<glm::dvec3> eye, target;
    std::optional<double> field_of_view; ///< Degrees, vertical.
};

/// --camera, --eye, --target and --fov.
void add_view(CLI::App& command, View& view);

/// The camera that looks from view.eye to view.target; else the one called view.camera, or with that index; else the
/// first, and the default camera, for pictures of this size, when there is none. view.field_of_view replaces its own.
/// Throws InputError listing the cameras, and UsageError for a view that shows nothing. Cheap enough to be called
/// before any work.
Camera choose_camera(const Input& input, const View& view, const Resolution& resolution);

} // namespace boxwood::cli
