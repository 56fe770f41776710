// SPDX-License-Identifier: MIT
#pragma once

#include "boxwood/buffer.hpp"
#include "shared/influence.h"

namespace boxwood {

/// The triangles, ascending, that have a point in the region of an area, and maybe others very close to it: no ray that
/// is in the region by cl/influence/influence.h hits one that is not listed. World space; `triangles` are three vertex
/// numbers each.
Buffer<std::uint32_t> area_triangles(Device& device, BufferView<const float> positions,
                                     BufferView<const std::uint32_t> triangles, const InfluenceRecord& area);

} // namespace boxwood
