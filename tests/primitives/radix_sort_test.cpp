// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>

#include "boxwood/error.hpp"
#include "boxwood/radix_sort.hpp"
#include "primitives/primitives_support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("primitives");

namespace {

template <class Key>
struct Sorted {
    std::vector<Key> keys;
    std::vector<std::uint32_t> values;
};

template <class Key>
Sorted<Key> sort_on_host(const std::vector<Key>& keys, int first_bit, int last_bit) {
    const int width = 8 * static_cast<int>(sizeof(Key));
    const auto digit = [=](Key key) { // shifts in two steps: a shift by the full width is undefined
        const Key above = first_bit == last_bit ? Key{0} : static_cast<Key>(key << (width - last_bit));
        return first_bit == last_bit ? Key{0} : static_cast<Key>(above >> (width - last_bit + first_bit));
    };
    Sorted<Key> sorted{keys, std::vector<std::uint32_t>(keys.size())};
    std::iota(sorted.values.begin(), sorted.values.end(), 0u);
    std::stable_sort(sorted.values.begin(), sorted.values.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return digit(keys[a]) < digit(keys[b]); });
    for (std::size_t i = 0; i < keys.size(); ++i) sorted.keys[i] = keys[sorted.values[i]];
    return sorted;
}

/// Values are the original positions, so a wrong order of equal keys shows.
template <class Key>
void check_sort(const std::vector<Key>& keys, int first_bit, int last_bit) {
    CAPTURE(keys.size());
    CAPTURE(first_bit);
    CAPTURE(last_bit);
    Device& device = test_device();
    const Sorted<Key> expected = sort_on_host(keys, first_bit, last_bit);
    std::vector<std::uint32_t> positions(keys.size());
    std::iota(positions.begin(), positions.end(), 0u);
    Guarded<Key> sorted_keys(device, keys.size());
    Guarded<std::uint32_t> sorted_values(device, keys.size());
    write(device, keys, sorted_keys.view());
    write(device, positions, sorted_values.view());
    radix_sort(device, sorted_keys.view(), sorted_values.view(), first_bit, last_bit);
    CHECK(same_bits(sorted_keys.values(), expected.keys));
    CHECK(same_bits(sorted_values.values(), expected.values));
    CHECK(sorted_keys.intact());
    CHECK(sorted_values.intact());
}

} // namespace

TEST_CASE_TEMPLATE("radix_sort: random keys of every size and tuning", Key, std::uint32_t, std::uint64_t) {
    for (const Tuning& tuning : tunings()) {
        const TuningScope scope(tuning);
        CAPTURE(tuning.group_size);
        for (const std::size_t size : boundary_sizes())
            if (size <= 100000) check_sort(random_values<Key>(size, size), 0, 8 * static_cast<int>(sizeof(Key)));
    }
}

TEST_CASE_TEMPLATE("radix_sort: equal keys keep their order", Key, std::uint32_t, std::uint64_t) {
    const std::size_t size = small_sizes() ? 301 : 100001;
    const int bits = 8 * static_cast<int>(sizeof(Key));
    std::vector<Key> keys(size, Key{0xabcdef01});
    check_sort(keys, 0, bits); // all equal
    for (std::size_t i = 0; i < size; ++i) keys[i] = static_cast<Key>(i * 7);
    check_sort(keys, 0, bits); // sorted already
    std::reverse(keys.begin(), keys.end());
    check_sort(keys, 0, bits);
    Random random(3);
    for (Key& key : keys) key = static_cast<Key>(random.below(5)) << (bits - 3);
    check_sort(keys, 0, bits); // few distinct keys, only top bits
    for (Key& key : keys) key = ~Key{0};
    keys[size / 2] = 0;
    check_sort(keys, 0, bits);
}

TEST_CASE_TEMPLATE("radix_sort: only the bits asked for decide", Key, std::uint32_t, std::uint64_t) {
    const std::vector<Key> keys = random_values<Key>(small_sizes() ? 301 : 5001, 11);
    const int width = 8 * static_cast<int>(sizeof(Key));
    // No bits, one bit, a digit of 10 exactly and one bit more, uneven digits, odd numbers of passes, Morton codes.
    for (const auto& [first, last] : std::vector<std::pair<int, int>>{
             {0, 0}, {7, 7}, {0, 1}, {3, 8}, {5, 15}, {5, 16}, {1, 24}, {0, 30}, {width - 1, width}, {2, width - 1}})
        check_sort(keys, first, last);
}

TEST_CASE("radix_sort: more than 2^24 pairs") {
    if (small_sizes()) return;
    // i -> 5 i mod size is a permutation, as 5 does not divide the size; the oracle needs no sort then.
    Device& device = test_device();
    const std::uint32_t size = (1u << 24) + 75;
    std::vector<std::uint32_t> keys(size), positions(size);
    for (std::uint32_t i = 0; i < size; ++i) {
        keys[i] = static_cast<std::uint32_t>(std::uint64_t{i} * 5 % size);
        positions[i] = i;
    }
    auto sorted_keys = upload(device, keys, "keys"), sorted_values = upload(device, positions, "values");
    radix_sort(device, sorted_keys, sorted_values, 0, 25);
    const std::vector<std::uint32_t> values = download(device, sorted_values), result = download(device, sorted_keys);
    std::size_t wrong = 0;
    for (std::uint32_t i = 0; i < size; ++i) wrong += result[i] != i || keys[values[i]] != i;
    CHECK(wrong == 0);
}

TEST_CASE("radix_sort: refuses what does not fit") {
    Device& device = test_device();
    auto keys = make_buffer<std::uint32_t>(device, 8, "keys");
    auto values = make_buffer<std::uint32_t>(device, 7, "values");
    CHECK_THROWS_AS(radix_sort(device, keys.view(), values.view()), InputError);
    CHECK_THROWS_AS(radix_sort(device, keys.view(), keys.view(), -1, 8), InputError);
    CHECK_THROWS_AS(radix_sort(device, keys.view(), keys.view(), 9, 8), InputError);
    CHECK_THROWS_AS(radix_sort(device, keys.view(), keys.view(), 0, 33), InputError);
}

TEST_CASE_TEMPLATE("radix_sort: memory does not depend on the number of threads", Key, std::uint32_t, std::uint64_t) {
    Device& device = test_device();
    // Slices as short as digits allow, and so many keys that their counts take three levels of tiles to scan.
    for (const std::size_t size : {5001u, 300001u, 6000001u}) {
        if (small_sizes() && size > 5001) continue;
        CAPTURE(size);
        for (const int bits : {2, 8, 30}) {
            CAPTURE(bits);
            auto keys = upload(device, random_values<Key>(size, 12), "keys");
            auto values = upload(device, std::vector<std::uint32_t>(size), "values");
            check_memory_by_compute_units([&] { radix_sort(device, keys, values, 0, bits); });
        }
    }
}
