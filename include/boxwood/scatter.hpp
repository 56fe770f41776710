// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "boxwood/buffer.hpp"

namespace boxwood {

namespace detail {

template <class T>
void scatter(Device& device, BufferView<const T> in, BufferView<const std::uint32_t> indices, BufferView<T> out);

} // namespace detail

/// out[indices[i]] = in[i] for every i < in.size(); indices are distinct and below out.size(). Buffers do not overlap.
/// T: int32, uint32, uint64, float, cl_float4, Aabb. O(n).
template <DeviceArray In>
void scatter(Device& device, const In& in, BufferView<const std::uint32_t> indices, BufferView<element_t<In>> out) {
    detail::scatter<element_t<In>>(device, in, indices, out);
}

} // namespace boxwood
