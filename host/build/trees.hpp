// SPDX-License-Identifier: MIT
// Trees over boxes, by either way to build.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "boxwood/morton.hpp"
#include "boxwood/topdown.hpp"
#include "volumes/binary_trees.hpp"

namespace boxwood {

/// Builds one linear BVH per range [offsets[t], offsets[t + 1]) of `boxes`, all in the same launches (Lauterbach et al.
/// 2009, Karras 2012; dissertation 3.3, 3.6.1), long runs of equal codes by codes of their own. No range is empty. With
/// a `stage` all launches count under it; without, each under its own.
BinaryTrees lbvh_trees(Device& device, BufferView<const Aabb> boxes, const std::vector<std::uint32_t>& offsets,
                       MortonBits morton, const std::string& stage = "");

/// The same by splitting nodes from the roots down; `areas` and `area_starts` as for topdown.
BinaryTrees topdown_trees(Device& device, BufferView<const Aabb> boxes, const std::vector<std::uint32_t>& offsets,
                          const TopDownOptions& options, const std::string& stage = "",
                          BufferView<const InfluenceRecord> areas = {},
                          BufferView<const std::uint32_t> area_starts = {});

} // namespace boxwood
