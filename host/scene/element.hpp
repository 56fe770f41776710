// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

#include "common/excerpt.hpp"

namespace boxwood {

/// An element of a scene as reports name it, such as meshes[0] "ball"; without a name by its index alone.
inline std::string element(const char* array, std::size_t index, const std::string& name) {
    return std::string(array) + "[" + std::to_string(index) + "]" + (name.empty() ? "" : " \"" + excerpt(name) + "\"");
}

} // namespace boxwood
