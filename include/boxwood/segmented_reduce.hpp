// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "boxwood/buffer.hpp"
#include "boxwood/operator.hpp"

namespace boxwood {

namespace detail {

template <class T>
void segmented_reduce(Device& device, BufferView<const T> in, BufferView<const std::uint32_t> offsets, Operator op,
                      BufferView<T> out);

} // namespace detail

/// out[s] = the operator over in[offsets[s] .. offsets[s + 1] - 1]; the neutral element for an empty segment.
/// `offsets` has out.size() + 1 ascending entries, the last at most in.size(). Balanced over elements, not over
/// segments. Types and order as in reduce, and cl_ulong4 (per component). O(n + segments).
template <DeviceArray In>
void segmented_reduce(Device& device, const In& in, BufferView<const std::uint32_t> offsets, Operator op,
                      BufferView<element_t<In>> out) {
    detail::segmented_reduce<element_t<In>>(device, in, offsets, op, out);
}

} // namespace boxwood
