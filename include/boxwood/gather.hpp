// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "boxwood/buffer.hpp"

namespace boxwood {

namespace detail {

template <class T>
void gather(Device& device, BufferView<const T> in, BufferView<const std::uint32_t> indices, BufferView<T> out);

} // namespace detail

/// out[i] = in[indices[i]] for every i < indices.size(); every index is below in.size(). Buffers do not overlap.
/// T: int32, uint32, uint64, float, cl_float4, Aabb. O(n).
template <DeviceArray In>
void gather(Device& device, const In& in, BufferView<const std::uint32_t> indices, BufferView<element_t<In>> out) {
    detail::gather<element_t<In>>(device, in, indices, out);
}

} // namespace boxwood
