// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "boxwood/tree_image.hpp"

namespace boxwood {

/// Throws InputError(file, element, what) unless the areas of a tree are finite and their index is one that traversal
/// comes to the end of. Does not look at their trees.
void check_areas(const TreeImage& tree, const std::string& file);

} // namespace boxwood
