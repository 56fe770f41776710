// SPDX-License-Identifier: MIT
#include "boxwood/reduce.hpp"

#include "primitives/element.hpp"

namespace boxwood::detail {

template <class T>
void reduce(Device& device, BufferView<const T> in, Operator op, BufferView<T> out) {
    detail::require(out.size() >= 1, "out", "needs room for one element");
    const Defines defines = detail::operator_defines<T>(op);
    Buffer<T> level;
    for (std::size_t tiles = detail::tiles_of(in.size()); tiles > 1; tiles = detail::tiles_of(tiles)) {
        Buffer<T> next = make_scratch<T>(device, tiles, "reduced tiles");
        detail::reduce_tiles<T>(device, in, defines, next.view());
        level = std::move(next);
        in = level;
    }
    detail::reduce_tiles<T>(device, in, defines, out);
}

template void reduce(Device&, BufferView<const std::int32_t>, Operator, BufferView<std::int32_t>);
template void reduce(Device&, BufferView<const std::uint32_t>, Operator, BufferView<std::uint32_t>);
template void reduce(Device&, BufferView<const std::uint64_t>, Operator, BufferView<std::uint64_t>);
template void reduce(Device&, BufferView<const float>, Operator, BufferView<float>);
template void reduce(Device&, BufferView<const cl_float4>, Operator, BufferView<cl_float4>);
template void reduce(Device&, BufferView<const Aabb>, Operator, BufferView<Aabb>);

} // namespace boxwood::detail
