// SPDX-License-Identifier: MIT
#pragma once

#include "boxwood/build.hpp"
#include "boxwood/topdown.hpp"

namespace boxwood {

/// How a builder other than lbvh splits nodes whose leaves test `block_size` primitives at once.
TopDownOptions topdown_options(Builder builder, std::uint32_t block_size);

} // namespace boxwood
