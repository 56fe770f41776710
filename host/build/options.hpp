// SPDX-License-Identifier: MIT
#pragma once

#include "boxwood/build.hpp"

namespace boxwood {

/// The options by which a scene is built: nothing automatic, `levels` by requirements(). Every check of build options
/// is here; throws InputError for those that do not go together or are out of range, as build() says.
BuildOptions resolve(const Scene& scene, BuildOptions options);

} // namespace boxwood
