// SPDX-License-Identifier: MIT
#include "boxwood/scan.hpp"

#include "primitives/element.hpp"

namespace boxwood {

namespace {

/// The fold of everything before each block is the exclusive scan of the blocks' folds: one level up, the same again.
template <class T>
void scan(Device& device, BufferView<const T> in, const Defines& op, bool inclusive, BufferView<T> out) {
    const std::size_t blocks = primitives::blocks_of(in.size());
    Buffer<T> before;
    if (blocks > 1) {
        before = make_scratch<T>(device, blocks, "scanned blocks");
        primitives::reduce_blocks<T>(device, in, op, before.view());
        scan<T>(device, before.view(), op, false, before.view());
    }
    Defines defines = op;
    defines["INCLUSIVE"] = std::to_string(inclusive ? 1 : 0);
    const Slices slices = cut(device, in.size(), primitives::block);
    launch(device, {"primitives/scan.cl", "scan", defines}, "scan", slices.slices, in, out, before,
           static_cast<cl_uint>(in.size()), slices.length, slices.slices);
}

template <class T>
void checked_scan(Device& device, BufferView<const T> in, Operator op, bool inclusive, BufferView<T> out) {
    primitives::require(out.size() >= in.size(), "out", "has fewer elements than in");
    if (in.size() > 0) scan<T>(device, in, primitives::operator_defines<T>(op), inclusive, out);
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

} // namespace boxwood
