// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "boxwood/influence.hpp"

namespace boxwood {

/// What is wrong with an area by itself (see validate), or nothing.
std::string area_fault(const InfluenceArea& area);

} // namespace boxwood
