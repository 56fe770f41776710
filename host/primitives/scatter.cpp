// SPDX-License-Identifier: MIT
#include "boxwood/scatter.hpp"

#include "primitives/element.hpp"

namespace boxwood::detail {

template <class T>
void scatter(Device& device, BufferView<const T> in, BufferView<const std::uint32_t> indices, BufferView<T> out) {
    detail::require(indices.size() == in.size(), "indices", "needs as many entries as in has elements");
    detail::require(out.size() >= in.size(), "out", "has fewer elements than in, so indices cannot be distinct");
    const Slices slices = cut(device, in.size());
    launch(device, {"primitives/scatter.cl", "scatter", detail::bits_defines<T>()}, "scatter", slices.slices,
           words_of(in), indices, words_of(out), static_cast<cl_uint>(in.size()), slices.length, slices.slices);
}

template void scatter(Device&, BufferView<const std::int32_t>, BufferView<const std::uint32_t>,
                      BufferView<std::int32_t>);
template void scatter(Device&, BufferView<const std::uint32_t>, BufferView<const std::uint32_t>,
                      BufferView<std::uint32_t>);
template void scatter(Device&, BufferView<const std::uint64_t>, BufferView<const std::uint32_t>,
                      BufferView<std::uint64_t>);
template void scatter(Device&, BufferView<const float>, BufferView<const std::uint32_t>, BufferView<float>);
template void scatter(Device&, BufferView<const cl_float4>, BufferView<const std::uint32_t>, BufferView<cl_float4>);
template void scatter(Device&, BufferView<const Aabb>, BufferView<const std::uint32_t>, BufferView<Aabb>);

} // namespace boxwood::detail
