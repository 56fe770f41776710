// SPDX-License-Identifier: MIT
#pragma once

#include "boxwood/buffer.hpp"
#include "boxwood/operator.hpp"

namespace boxwood {

/// out[i] = the operator over in[0..i-1], the neutral element for i = 0. `out` has in.size() elements and may be the
/// same buffer as `in`. T: int32, uint32, uint64, float, cl_float4. Fixed order, as in reduce. O(n).
template <class T>
void exclusive_scan(Device& device, BufferView<const T> in, Operator op, BufferView<T> out);

/// out[i] = the operator over in[0..i].
template <class T>
void inclusive_scan(Device& device, BufferView<const T> in, Operator op, BufferView<T> out);

} // namespace boxwood
