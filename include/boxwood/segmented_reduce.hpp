// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "boxwood/buffer.hpp"
#include "boxwood/operator.hpp"

namespace boxwood {

/// out[s] = the operator over in[offsets[s] .. offsets[s + 1] - 1]; the neutral element for an empty segment.
/// `offsets` has out.size() + 1 ascending entries, the last at most in.size(). Balanced over elements, not over
/// segments. Types and order as in reduce, and cl_ulong4 (per component). O(n + segments).
template <class T>
void segmented_reduce(Device& device, BufferView<const T> in, BufferView<const std::uint32_t> offsets, Operator op,
                      BufferView<T> out);

} // namespace boxwood
