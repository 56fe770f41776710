// SPDX-License-Identifier: MIT
#include "boxwood/scan.hpp"

#include <string>
#include <vector>

#include "primitives/element.hpp"
#include "primitives/scan.hpp"

namespace boxwood::detail {

namespace {

/// What is before each tile of 1024, before each tile of these, and so on.
template <class T>
using Levels = std::vector<Buffer<T>>;

template <class T>
Levels<T> make_levels(Device& device, std::size_t count) {
    Levels<T> levels;
    for (std::size_t tiles = detail::tiles_of(count); tiles > 1; tiles = detail::tiles_of(tiles))
        levels.push_back(make_scratch<T>(device, tiles, "scanned tiles"));
    return levels;
}

/// The fold of everything before each tile is the exclusive scan of the tiles' folds: one level up, the same again.
template <class T>
void scan(Device& device, BufferView<const T> in, const Defines& op, bool inclusive, BufferView<T> out,
          Levels<T>&& levels, std::size_t level = 0) {
    const std::size_t tiles = detail::tiles_of(in.size());
    BufferView<T> before;
    if (tiles > 1) {
        before = levels[level].prefix(tiles);
        detail::reduce_tiles<T>(device, in, op, before);
        scan<T>(device, before, op, false, before, std::move(levels), level + 1);
    }
    Defines defines = op;
    defines["INCLUSIVE"] = std::to_string(inclusive ? 1 : 0);
    const Slices slices = cut(device, in.size(), detail::tile);
    launch(device, {"primitives/scan.cl", "scan", defines}, "scan", slices.slices, scalars_of(in), scalars_of(out),
           scalars_of(before), static_cast<cl_uint>(in.size()), slices.length, slices.slices);
}

template <class T>
void checked_scan(Device& device, BufferView<const T> in, Operator op, bool inclusive, BufferView<T> out) {
    detail::require(out.size() >= in.size(), "out", "has fewer elements than in");
    if (in.size() == 0) return;
    scan<T>(device, in, detail::operator_defines<T>(op), inclusive, out, make_levels<T>(device, in.size()));
}

} // namespace

template <class T>
void exclusive_scan(Device& device, BufferView<const T> in, Operator op, BufferView<T> out) {
    checked_scan(device, in, op, false, out);
}

template <class T>
void inclusive_scan(Device& device, BufferView<const T> in, Operator op, BufferView<T> out) {
    checked_scan(device, in, op, true, out);
}

void exclusive_sums(Device& device, BufferView<const std::uint32_t> in, BufferView<std::uint32_t> out,
                    std::size_t most) {
    if (in.size() == 0) return;
    scan<std::uint32_t>(device, in, operator_defines<std::uint32_t>(Operator::sum), false, out,
                        make_levels<std::uint32_t>(device, most));
}

template void exclusive_scan(Device&, BufferView<const std::int32_t>, Operator, BufferView<std::int32_t>);
template void exclusive_scan(Device&, BufferView<const std::uint32_t>, Operator, BufferView<std::uint32_t>);
template void exclusive_scan(Device&, BufferView<const std::uint64_t>, Operator, BufferView<std::uint64_t>);
template void exclusive_scan(Device&, BufferView<const float>, Operator, BufferView<float>);
template void exclusive_scan(Device&, BufferView<const cl_float4>, Operator, BufferView<cl_float4>);
template void inclusive_scan(Device&, BufferView<const std::int32_t>, Operator, BufferView<std::int32_t>);
template void inclusive_scan(Device&, BufferView<const std::uint32_t>, Operator, BufferView<std::uint32_t>);
template void inclusive_scan(Device&, BufferView<const std::uint64_t>, Operator, BufferView<std::uint64_t>);
template void inclusive_scan(Device&, BufferView<const float>, Operator, BufferView<float>);
template void inclusive_scan(Device&, BufferView<const cl_float4>, Operator, BufferView<cl_float4>);

} // namespace boxwood::detail
