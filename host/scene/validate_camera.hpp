// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "boxwood/scene.hpp"

namespace boxwood {

/// Throws InputError(file, where + member, what) unless the camera keeps its promises: a transform that has an inverse,
/// a field of view in (0, pi) or a half height that is positive and finite. `where` is "" or ends in a full stop.
void validate_camera(const Camera& camera, const std::string& file, const std::string& where);

} // namespace boxwood
