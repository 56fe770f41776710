// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <utility>

#include "boxwood/morton.hpp"
#include "boxwood/topology.hpp"

namespace boxwood {

namespace detail {

template <class Key>
Topology lbvh(Device& device, BufferView<const Key> keys, KeyFormat format, Buffer<std::uint32_t> order,
              Buffer<std::uint32_t> offsets);

} // namespace detail

/// Builds the linear BVH of every tree from sorted keys, in one launch: the radix tree over (key, position), so equal
/// keys are split by position (Karras 2012; found bottom-up as in Apetrei 2014; dissertation 3.3.3). `order` and
/// `offsets` are moved into the result. Keys are sorted by their low key_bits. O(n).
template <DeviceArray Keys>
Topology lbvh(Device& device, const Keys& keys, KeyFormat format, Buffer<std::uint32_t> order,
              Buffer<std::uint32_t> offsets) {
    return detail::lbvh<element_t<Keys>>(device, keys, format, std::move(order), std::move(offsets));
}

} // namespace boxwood
