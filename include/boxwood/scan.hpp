// SPDX-License-Identifier: MIT
#pragma once

#include "boxwood/buffer.hpp"
#include "boxwood/operator.hpp"

namespace boxwood {

namespace detail {

template <class T>
void exclusive_scan(Device& device, BufferView<const T> in, Operator op, BufferView<T> out);
template <class T>
void inclusive_scan(Device& device, BufferView<const T> in, Operator op, BufferView<T> out);

} // namespace detail

/// out[i] = the operator over in[0..i-1], the neutral element for i = 0. `out` has in.size() elements and may be the
/// same buffer as `in`. T: int32, uint32, uint64, float, cl_float4 (per component). O(n).
///
/// Sums of floats are added in a fixed order that does not depend on the device, but in another one than reduce's: the last
/// sum may differ from its result by rounding. Where no element is negative, sums never fall: out[i] <= out[i + 1]. Where
/// some are, a sum may be smaller than the one before by rounding, even at an element that is not negative.
template <DeviceArray In>
void exclusive_scan(Device& device, const In& in, Operator op, BufferView<element_t<In>> out) {
    detail::exclusive_scan<element_t<In>>(device, in, op, out);
}

/// out[i] = the operator over in[0..i]. The rest as of exclusive_scan.
template <DeviceArray In>
void inclusive_scan(Device& device, const In& in, Operator op, BufferView<element_t<In>> out) {
    detail::inclusive_scan<element_t<In>>(device, in, op, out);
}

} // namespace boxwood
