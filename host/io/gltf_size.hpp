// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "io/gltf_nodes.hpp"

namespace boxwood {

/// Bytes of main memory of this machine, or what limits leave this process of them.
std::uint64_t host_memory();

/// Refuses what a few bytes of a file would make too large, before anything is read: more than largest_implicit_total
/// elements without data (accessors without a buffer view), or meshes, instances and pictures of more than `memory`
/// bytes (parts of a file that are read many times over). `used` are the meshes that are shown. Throws InputError.
/// O(nodes + primitives).
void check_size(const GltfDocument& document, const std::vector<PlacedNode>& nodes, const std::vector<bool>& used,
                std::uint64_t memory);

} // namespace boxwood
