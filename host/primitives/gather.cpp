// SPDX-License-Identifier: MIT
#include "boxwood/gather.hpp"

#include "primitives/element.hpp"

namespace boxwood::detail {

template <class T>
void gather(Device& device, BufferView<const T> in, BufferView<const std::uint32_t> indices, BufferView<T> out) {
    detail::require(out.size() >= indices.size(), "out", "has fewer elements than indices");
    const Slices slices = cut(device, indices.size());
    launch(device, {"primitives/gather.cl", "gather", detail::bits_defines<T>()}, "gather", slices.slices, words_of(in),
           indices, words_of(out), static_cast<cl_uint>(indices.size()), slices.length, slices.slices);
}

template void gather(Device&, BufferView<const std::int32_t>, BufferView<const std::uint32_t>,
                     BufferView<std::int32_t>);
template void gather(Device&, BufferView<const std::uint32_t>, BufferView<const std::uint32_t>,
                     BufferView<std::uint32_t>);
template void gather(Device&, BufferView<const std::uint64_t>, BufferView<const std::uint32_t>,
                     BufferView<std::uint64_t>);
template void gather(Device&, BufferView<const float>, BufferView<const std::uint32_t>, BufferView<float>);
template void gather(Device&, BufferView<const cl_float4>, BufferView<const std::uint32_t>, BufferView<cl_float4>);
template void gather(Device&, BufferView<const Aabb>, BufferView<const std::uint32_t>, BufferView<Aabb>);

} // namespace boxwood::detail
