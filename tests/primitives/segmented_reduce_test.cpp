// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "boxwood/error.hpp"
#include "boxwood/segmented_reduce.hpp"
#include "primitives/fold_oracle.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("primitives");

namespace {

using Offsets = std::vector<std::uint32_t>;

template <class T>
std::vector<T> reduced(const std::vector<T>& values, const Offsets& offsets, Operator op) {
    Device& device = test_device();
    const Buffer<T> in = upload(device, values, "values");
    const auto borders = upload(device, offsets, "offsets");
    const Guarded<T> out(device, offsets.size() - 1);
    segmented_reduce(device, in, borders, op, out.view());
    CHECK(out.intact());
    return out.values();
}

template <class T>
void check_segments(std::size_t count, const Offsets& offsets, Operator op) {
    CAPTURE(count);
    CAPTURE(offsets.size());
    const std::vector<T> values = random_values<T>(count, count + 17);
    const std::vector<T> actual = reduced(values, offsets, op);
    REQUIRE(actual.size() + 1 == offsets.size());
    for (std::size_t s = 0; s < actual.size(); ++s) {
        CAPTURE(s);
        check_fold(actual[s], values, offsets[s], offsets[s + 1], op);
    }
}

/// Segments of the given lengths after `first` elements that belong to none.
Offsets offsets_of(const std::vector<std::uint32_t>& lengths, std::uint32_t first = 0) {
    Offsets offsets{first};
    for (const std::uint32_t length : lengths) offsets.push_back(offsets.back() + length);
    return offsets;
}

/// Lengths that mix nothing, a few, about a tile, and many tiles.
Offsets random_offsets(std::size_t count, std::uint64_t salt) {
    Random random(salt);
    Offsets offsets{random.below(3)};
    const std::uint32_t longest[] = {1, 2, 9, 200, 3000, 60000};
    while (true) {
        const std::uint32_t next = offsets.back() + random.below(longest[random.below(6)]);
        if (next > count) return offsets;
        offsets.push_back(next);
    }
}

} // namespace

TEST_CASE_TEMPLATE("segmented_reduce: segments of random lengths", T, std::int32_t, std::uint32_t, std::uint64_t, float,
                   cl_float4, cl_ulong4, Aabb) {
    const std::size_t size = small_sizes() ? 2101 : 400001;
    for (const Operator op : operators<T>()) check_segments<T>(size, random_offsets(size, 31), op);
}

TEST_CASE("segmented_reduce: segments at the borders of tiles") {
    const auto b = static_cast<std::uint32_t>(tile);
    const std::vector<Offsets> cases{
        {0},                            // no segment
        {0, 0},                         // one, empty
        offsets_of({0, 0, 1, 0}),       // a single element among empty segments
        offsets_of({b}),                // exactly a tile
        offsets_of({b - 1, 1, 1}),      // up to a border and over it
        offsets_of({b, b, b}),          // every border is a tile's
        offsets_of({b - 1, 2, b - 1}),  // one element on each side of a border
        offsets_of({0, b, 0, 0, b, 0}), // empty segments at tile borders
        offsets_of({3 * b}),
        offsets_of({1, 3 * b, 1}),              // whole tiles inside
        offsets_of({5, 2 * b, 0, 2 * b, 7}, 3), // one leaves a tile in which another ends; a gap before
        offsets_of({10}, 2 * b),
        offsets_of({2 * b}, b - 1)}; // tiles before the first segment
    for (const Offsets& offsets : cases) {
        check_segments<float>(offsets.back(), offsets, Operator::sum);
        if (small_sizes()) continue;
        check_segments<Aabb>(offsets.back(), offsets, Operator::sum);
        check_segments<std::uint32_t>(offsets.back() + 3 * b + 5, offsets, Operator::sum); // elements after the last
    }
}

TEST_CASE("segmented_reduce: heads of more than one tile of tiles") {
    if (small_sizes()) return;
    const auto level = static_cast<std::uint32_t>(tile * tile);
    check_segments<std::uint32_t>(2 * level + 9, offsets_of({level - 1, 2, level, 0, 8}), Operator::sum);
    check_segments<std::uint32_t>(16 * level + 4099, offsets_of({3, 16 * level + 4000, 5}), Operator::sum);
}

TEST_CASE_TEMPLATE("segmented_reduce: the tuning does not change a bit", T, float, Aabb) {
    const std::size_t size = small_sizes() ? 2101 : 150001;
    const std::vector<T> values = random_values<T>(size, 5);
    for (const std::uint64_t salt : {1, 2, 3}) {
        const Offsets offsets = random_offsets(size, salt);
        const std::vector<T> expected = reduced(values, offsets, Operator::sum);
        for (const Tuning& tuning : tunings()) {
            const TuningScope scope(tuning);
            CHECK(same_bits(reduced(values, offsets, Operator::sum), expected));
        }
    }
}

TEST_CASE("segmented_reduce: refuses what does not fit") {
    Device& device = test_device();
    auto in = make_buffer<Aabb>(device, 8, "in");
    auto offsets = make_buffer<std::uint32_t>(device, 3, "offsets");
    CHECK_THROWS_AS(segmented_reduce(device, in, offsets, Operator::sum, in), InputError);
    CHECK_THROWS_AS(segmented_reduce(device, in, offsets, Operator::max, in.prefix(2)), InputError);
    CHECK_THROWS_AS(segmented_reduce(device, in, BufferView<const std::uint32_t>(), Operator::sum, in.prefix(0)),
                    InputError);
}
