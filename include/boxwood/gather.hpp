// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "boxwood/buffer.hpp"

namespace boxwood {

/// out[i] = in[indices[i]] for every i < indices.size(); every index is below in.size(). Buffers do not overlap.
/// T: int32, uint32, uint64, float, cl_float4, Aabb. O(n).
template <class T>
void gather(Device& device, BufferView<const T> in, BufferView<const std::uint32_t> indices, BufferView<T> out);

} // namespace boxwood
