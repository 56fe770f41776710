// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "boxwood/build.hpp"
#include "boxwood/morton.hpp"
#include "boxwood/topdown.hpp"
#include "boxwood/topology.hpp"
#include "shared/aabb.h"
#include "shared/obb.h"

namespace boxwood {

/// Binary trees with their boxes: what every layout is made from.
struct Forest {
    Topology topology;
    Buffer<Aabb> tree_bounds; ///< One box per tree.
    Buffer<Aabb> volumes;     ///< As from aabb_volumes.
    Buffer<Obb> boxes;        ///< As from obb_volumes; empty without oriented boxes.
};

/// Builds one linear BVH per range [offsets[t], offsets[t + 1]) of `boxes`, all in the same launches (dissertation 3.3,
/// 3.6.1), long runs of equal codes by codes of their own. No range is empty. With a `stage` all launches count under it;
/// without, each under its own.
Forest build_forest(Device& device, BufferView<const Aabb> boxes, const std::vector<std::uint32_t>& offsets,
                    MortonBits morton, const std::string& stage = "");

/// The same by splitting nodes from the roots down; `areas` and `area_starts` as for topdown.
Forest build_forest(Device& device, BufferView<const Aabb> boxes, const std::vector<std::uint32_t>& offsets,
                    const TopDownOptions& options, const std::string& stage = "",
                    BufferView<const InfluenceRecord> areas = {}, BufferView<const std::uint32_t> area_starts = {});

/// How a builder other than lbvh splits nodes whose leaves test `block` primitives at once.
TopDownOptions topdown_options(Builder builder, std::uint32_t block);

/// The box of the primitives of each tree, one per range of `offsets`.
Buffer<Aabb> bounds_of_trees(Device& device, BufferView<const Aabb> boxes, BufferView<const std::uint32_t> offsets);

} // namespace boxwood
