// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "boxwood/buffer.hpp"

namespace boxwood {

/// Sorts (key, value) pairs in place, stably and ascending, by the key bits [first_bit, last_bit). Key: uint32 or
/// uint64. `values` has keys.size() elements. Scratch for one more copy of both. O(n * bits).
template <class Key>
void radix_sort(Device& device, BufferView<Key> keys, BufferView<std::uint32_t> values, int first_bit = 0,
                int last_bit = 8 * static_cast<int>(sizeof(Key)));

} // namespace boxwood
