// SPDX-License-Identifier: MIT
#pragma once

#include "boxwood/shading_requirements.hpp"

namespace boxwood {

/// The part of reasons() about shading.
std::vector<Reason> shading_reasons(const Scene& scene);

} // namespace boxwood
