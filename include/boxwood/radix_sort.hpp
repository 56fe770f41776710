// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "boxwood/buffer.hpp"

namespace boxwood {

namespace detail {

template <class Key>
void radix_sort(Device& device, BufferView<Key> keys, BufferView<std::uint32_t> values, int first_bit, int last_bit);

} // namespace detail

/// Sorts (key, value) pairs in place, stably and ascending, by the key bits [first_bit, last_bit). Key: uint32 or
/// uint64. `values` has keys.size() elements. Scratch for one more copy of both. O(n * bits).
template <DeviceArray Keys>
void radix_sort(Device& device, Keys&& keys, BufferView<std::uint32_t> values, int first_bit = 0,
                int last_bit = 8 * static_cast<int>(sizeof(element_t<Keys>))) {
    detail::radix_sort<element_t<Keys>>(device, keys, values, first_bit, last_bit);
}

} // namespace boxwood
