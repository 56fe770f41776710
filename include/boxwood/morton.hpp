// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "boxwood/buffer.hpp"
#include "shared/aabb.h"

namespace boxwood {

/// Length of Morton codes: 30 bits (10 per axis) or 63 (21 per axis).
enum class MortonBits { bits30 = 30, bits63 = 63 };

/// Where the parts of a sort key lie: the code in bits [0, code_bits), the tree above it in [code_bits, key_bits).
struct KeyFormat {
    int code_bits = 30; ///< 3 * bits per axis.
    int key_bits = 30;
};

/// The format for `trees` trees: the code asked for, or as many bits per axis as fit a key of 64 beside the tree.
KeyFormat key_format(MortonBits morton, std::size_t trees);

namespace detail {

template <class Key>
void morton_keys(Device& device, BufferView<const Aabb> boxes, BufferView<const std::uint32_t> offsets,
                 BufferView<const Aabb> tree_bounds, KeyFormat format, BufferView<Key> keys,
                 BufferView<std::uint32_t> order);

} // namespace detail

/// The pairs to sort: order[i] = i, and keys[i] = tree of primitive i above the Morton code of its box's centre, in the cube that starts at the lower corner
/// of the tree's bounds and has their largest extent as its side (dissertation 3.3.1, 3.6.1). The same bits for a scene
/// scaled by a power of two. Key: uint32 (one tree, key_bits <= 32) or uint64. `offsets` as in Topology, but of
/// unsorted primitives; `tree_bounds` has one finite box per tree. O(n).
template <DeviceArray Keys>
void morton_keys(Device& device, BufferView<const Aabb> boxes, BufferView<const std::uint32_t> offsets,
                 BufferView<const Aabb> tree_bounds, KeyFormat format, Keys&& keys, BufferView<std::uint32_t> order) {
    detail::morton_keys<element_t<Keys>>(device, boxes, offsets, tree_bounds, format, keys, order);
}

} // namespace boxwood
