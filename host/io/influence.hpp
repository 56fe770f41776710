// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "boxwood/influence.hpp"

namespace boxwood {

/// load_areas of the text of a file, which errors name `source`.
std::vector<InfluenceArea> read_areas(std::string_view text, const std::string& source);

} // namespace boxwood
