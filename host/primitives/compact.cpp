// SPDX-License-Identifier: MIT
#include "boxwood/compact.hpp"

#include "primitives/element.hpp"
#include "primitives/scan.hpp"

namespace boxwood::detail {

template <class T>
void compact(Device& device, BufferView<const T> in, BufferView<const std::uint32_t> flags, BufferView<T> out,
             BufferView<std::uint32_t> count) {
    detail::require(flags.size() == in.size(), "flags", "needs as many entries as in has elements");
    detail::require(out.size() >= in.size(), "out", "has fewer elements than in");
    detail::require(count.size() >= 1, "count", "needs room for one element");
    if (in.size() == 0) return fill(device, count.prefix(1), 0);

    const KernelRef count_kernel{"primitives/compact.cl", "compact_count", detail::bits_defines<T>()};
    const KernelRef move_kernel{"primitives/compact.cl", "compact", detail::bits_defines<T>()};
    const Slices slices = cut(device, in.size());
    const std::size_t most = most_slices(device, in.size());
    auto kept = make_scratch<std::uint32_t>(device, most, "kept elements by slice");
    auto before = make_scratch<std::uint32_t>(device, most, "kept elements before slices");
    launch(device, count_kernel, "compact: count", slices.slices, flags, kept, static_cast<cl_uint>(in.size()),
           slices.length, slices.slices);
    detail::exclusive_sums(device, kept.prefix(slices.slices), before.prefix(slices.slices), most);
    launch(device, move_kernel, "compact: move", slices.slices, words_of(in), flags, before, kept, words_of(out), count,
           slices.length, slices.slices);
}

template void compact(Device&, BufferView<const std::int32_t>, BufferView<const std::uint32_t>,
                      BufferView<std::int32_t>, BufferView<std::uint32_t>);
template void compact(Device&, BufferView<const std::uint32_t>, BufferView<const std::uint32_t>,
                      BufferView<std::uint32_t>, BufferView<std::uint32_t>);
template void compact(Device&, BufferView<const std::uint64_t>, BufferView<const std::uint32_t>,
                      BufferView<std::uint64_t>, BufferView<std::uint32_t>);
template void compact(Device&, BufferView<const float>, BufferView<const std::uint32_t>, BufferView<float>,
                      BufferView<std::uint32_t>);
template void compact(Device&, BufferView<const cl_float4>, BufferView<const std::uint32_t>, BufferView<cl_float4>,
                      BufferView<std::uint32_t>);
template void compact(Device&, BufferView<const Aabb>, BufferView<const std::uint32_t>, BufferView<Aabb>,
                      BufferView<std::uint32_t>);

} // namespace boxwood::detail
