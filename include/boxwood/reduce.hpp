// SPDX-License-Identifier: MIT
#pragma once

#include "boxwood/buffer.hpp"
#include "boxwood/operator.hpp"

namespace boxwood {

namespace detail {

template <class T>
void reduce(Device& device, BufferView<const T> in, Operator op, BufferView<T> out);

} // namespace detail

/// out[0] = the operator over all of `in`; the operator's neutral element when `in` is empty. T: int32, uint32,
/// uint64, float, cl_float4 (per component), Aabb (sum: hull). Sums of floats are added in a fixed order that does not
/// depend on the device. O(n).
template <DeviceArray In>
void reduce(Device& device, const In& in, Operator op, BufferView<element_t<In>> out) {
    detail::reduce<element_t<In>>(device, in, op, out);
}

} // namespace boxwood
