// SPDX-License-Identifier: MIT
#include "boxwood/morton.hpp"

#include <bit>

#include "runtime/launch.hpp"

namespace boxwood {

KeyFormat key_format(MortonBits morton, std::size_t trees) {
    const int tree_bits = trees > 1 ? static_cast<int>(std::bit_width(trees - 1)) : 0;
    int axis_bits = static_cast<int>(morton) / 3;
    while (3 * axis_bits + tree_bits > 64) --axis_bits;
    return {3 * axis_bits, 3 * axis_bits + tree_bits};
}

template <class Key>
void detail::morton_keys(Device& device, BufferView<const Aabb> boxes, BufferView<const std::uint32_t> offsets,
                         BufferView<const Aabb> tree_bounds, KeyFormat format, BufferView<Key> keys,
                         BufferView<std::uint32_t> order) {
    const Slices slices = cut(device, boxes.size());
    const KernelRef kernel{"build/morton.cl",
                           "morton_keys",
                           {{"KEY", sizeof(Key) == 4 ? "uint" : "ulong"},
                            {"AXIS_BITS", std::to_string(format.code_bits / 3)},
                            {"TREE_IN_KEY", tree_bounds.size() > 1 ? "1" : "0"}}};
    launch(device, kernel, "morton keys", slices.slices, boxes, offsets, tree_bounds, keys, order,
           static_cast<std::uint32_t>(tree_bounds.size()), static_cast<std::uint32_t>(boxes.size()), slices.length);
}

template void detail::morton_keys<std::uint32_t>(Device&, BufferView<const Aabb>, BufferView<const std::uint32_t>,
                                                 BufferView<const Aabb>, KeyFormat, BufferView<std::uint32_t>,
                                                 BufferView<std::uint32_t>);
template void detail::morton_keys<std::uint64_t>(Device&, BufferView<const Aabb>, BufferView<const std::uint32_t>,
                                                 BufferView<const Aabb>, KeyFormat, BufferView<std::uint64_t>,
                                                 BufferView<std::uint32_t>);

} // namespace boxwood
