// SPDX-License-Identifier: MIT
#include "boxwood/radix_sort.hpp"

#include <algorithm>
#include <utility>

#include "primitives/element.hpp"
#include "primitives/scan.hpp"

namespace boxwood::detail {

namespace {

/// Most bits sorted in one pass; a work-item has a counter per digit and writes to two places per digit. Groups of one
/// are a processor core's, where fewer passes stop paying once each writes to too many places (measured on 1M pairs of
/// 32 bits, two pinned cores: four passes of 8 bits take about 8.2 ms, three of 11 about 9.4). With at most 10 bits, 32
/// are sorted in four passes of 8 and the 30 of a Morton code in three. Larger groups are a GPU's, where a work-item
/// should need no more than registers and slices should stay short.
int most_digit_bits(const Device& device) { return device.tuning().group_size == 1 ? 10 : 4; }

template <class Key>
struct Pairs {
    BufferView<Key> keys;
    BufferView<std::uint32_t> values;
};

/// Sorts `from` into `to` by the `bits` bits of the key above `shift`.
template <class Key>
void sort_pass(Device& device, const Pairs<Key>& from, const Pairs<Key>& to, int shift, int bits) {
    const Defines defines{{"KEY", detail::Element<Key>::scalar},
                          {"DIGIT_BITS", std::to_string(most_digit_bits(device))}};
    const std::size_t digits = std::size_t{1} << bits;
    const auto count = static_cast<cl_uint>(from.keys.size());
    const auto first_bit = static_cast<cl_uint>(shift);
    const auto mask = static_cast<cl_uint>(digits - 1);
    // Slices of a few times as many pairs as there are digits: counting and scanning stay cheap beside moving.
    const Slices slices = cut(device, count, 4 * digits);
    const std::size_t most_counts = digits * most_slices(device, count, 4 * digits);
    auto scratch = make_scratch<std::uint32_t>(device, most_counts, "digit counts");
    const BufferView<std::uint32_t> counts = scratch.prefix(digits * slices.slices);
    launch(device, {"primitives/radix_sort.cl", "radix_count", defines}, "radix sort: count", slices.slices, from.keys,
           counts, count, first_bit, mask, slices.length, slices.slices);
    detail::exclusive_sums(device, counts, counts, most_counts);
    launch(device, {"primitives/radix_sort.cl", "radix_move", defines}, "radix sort: move", slices.slices, from.keys,
           from.values, counts, to.keys, to.values, count, first_bit, mask, slices.length, slices.slices);
}

} // namespace

template <class Key>
void radix_sort(Device& device, BufferView<Key> keys, BufferView<std::uint32_t> values, int first_bit, int last_bit) {
    detail::require(values.size() == keys.size(), "values", "needs as many elements as keys");
    detail::require(first_bit >= 0 && first_bit <= last_bit && last_bit <= 8 * static_cast<int>(sizeof(Key)),
                    "first_bit, last_bit", "must be an ascending range of the key's bits");
    const std::size_t count = keys.size();
    if (count < 2 || first_bit == last_bit) return;

    auto spare_keys = make_scratch<Key>(device, count, "sorted keys");
    auto spare_values = make_scratch<std::uint32_t>(device, count, "sorted values");
    Pairs<Key> from{keys, values}, to{spare_keys, spare_values};
    const int most = most_digit_bits(device);
    const int passes = (last_bit - first_bit + most - 1) / most;
    for (int pass = 0, bit = first_bit; pass < passes; ++pass) {
        const int bits = (last_bit - bit + passes - pass - 1) / (passes - pass);
        sort_pass(device, from, to, bit, bits);
        std::swap(from, to);
        bit += bits;
    }
    if (passes % 2 != 0) {
        copy(device, spare_keys, keys);
        copy(device, spare_values, values);
    }
}

template void radix_sort(Device&, BufferView<std::uint32_t>, BufferView<std::uint32_t>, int, int);
template void radix_sort(Device&, BufferView<std::uint64_t>, BufferView<std::uint32_t>, int, int);

} // namespace boxwood::detail
