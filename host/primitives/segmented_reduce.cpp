// SPDX-License-Identifier: MIT
#include "boxwood/segmented_reduce.hpp"

#include "primitives/element.hpp"

namespace boxwood::detail {

namespace {

const char* const file = "primitives/segmented_reduce.cl";

template <class T>
void segmented(Device& device, BufferView<const T> in, BufferView<const std::uint32_t> offsets, const Defines& defines,
               BufferView<T> out) {
    const std::size_t segments = offsets.size() - 1;
    const Slices over_segments = cut(device, segments);
    launch(device, {file, "segmented_empty", defines}, "segmented reduce: empty", over_segments.slices, offsets,
           scalars_of(out), static_cast<cl_uint>(segments), over_segments.length, over_segments.slices);
    if (in.size() == 0) return;

    const std::size_t tiles = detail::tiles_of(in.size());
    auto head = make_scratch<T>(device, tiles, "heads of tiles");
    auto tail = make_scratch<T>(device, tiles, "tails of tiles");
    auto tail_segment = make_scratch<std::uint32_t>(device, tiles, "segments of tails");
    auto spans = make_scratch<std::uint32_t>(device, tiles + 1, "spans of heads");
    const Slices over_elements = cut(device, in.size(), detail::tile);
    launch(device, {file, "segmented_reduce", defines}, "segmented reduce", over_elements.slices, scalars_of(in),
           offsets, scalars_of(out), scalars_of(head.view()), scalars_of(tail.view()), tail_segment, spans,
           static_cast<cl_uint>(in.size()), static_cast<cl_uint>(segments), over_elements.length, over_elements.slices);
    if (tiles == 1) return;

    auto reduced = make_scratch<T>(device, tiles, "reduced heads");
    segmented<T>(device, head, spans, defines, reduced);
    const Slices over_tiles = cut(device, tiles);
    launch(device, {file, "segmented_finish", defines}, "segmented reduce: finish", over_tiles.slices,
           scalars_of(tail.view()), scalars_of(reduced.view()), tail_segment, scalars_of(out),
           static_cast<cl_uint>(tiles), over_tiles.length, over_tiles.slices);
}

} // namespace

template <class T>
void segmented_reduce(Device& device, BufferView<const T> in, BufferView<const std::uint32_t> offsets, Operator op,
                      BufferView<T> out) {
    detail::require(offsets.size() == out.size() + 1, "offsets", "needs one entry more than out has segments");
    const Defines defines = detail::operator_defines<T>(op);
    if (out.size() > 0) segmented<T>(device, in, offsets, defines, out);
}

template void segmented_reduce(Device&, BufferView<const std::int32_t>, BufferView<const std::uint32_t>, Operator,
                               BufferView<std::int32_t>);
template void segmented_reduce(Device&, BufferView<const std::uint32_t>, BufferView<const std::uint32_t>, Operator,
                               BufferView<std::uint32_t>);
template void segmented_reduce(Device&, BufferView<const std::uint64_t>, BufferView<const std::uint32_t>, Operator,
                               BufferView<std::uint64_t>);
template void segmented_reduce(Device&, BufferView<const float>, BufferView<const std::uint32_t>, Operator,
                               BufferView<float>);
template void segmented_reduce(Device&, BufferView<const cl_float4>, BufferView<const std::uint32_t>, Operator,
                               BufferView<cl_float4>);
template void segmented_reduce(Device&, BufferView<const cl_ulong4>, BufferView<const std::uint32_t>, Operator,
                               BufferView<cl_ulong4>);
template void segmented_reduce(Device&, BufferView<const Aabb>, BufferView<const std::uint32_t>, Operator,
                               BufferView<Aabb>);

} // namespace boxwood::detail
