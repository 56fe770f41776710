// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "boxwood/buffer.hpp"

namespace boxwood {

namespace detail {

template <class T>
void compact(Device& device, BufferView<const T> in, BufferView<const std::uint32_t> flags, BufferView<T> out,
             BufferView<std::uint32_t> count);

} // namespace detail

/// Keeps the elements whose flag is not 0, in order: writes them to the start of `out` (in.size() elements of room) and
/// their number to count[0]. T: int32, uint32, uint64, float, cl_float4, Aabb. O(n).
template <DeviceArray In>
void compact(Device& device, const In& in, BufferView<const std::uint32_t> flags, BufferView<element_t<In>> out,
             BufferView<std::uint32_t> count) {
    detail::compact<element_t<In>>(device, in, flags, out, count);
}

} // namespace boxwood
