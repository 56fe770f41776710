// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <numeric>

#include "boxwood/error.hpp"
#include "boxwood/scatter.hpp"
#include "primitives/primitives_support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("primitives");

namespace {

/// `size` distinct indices out of [0, room), in random order.
std::vector<std::uint32_t> distinct_indices(std::size_t size, std::size_t room) {
    Random random(size);
    std::vector<std::uint32_t> indices(room);
    std::iota(indices.begin(), indices.end(), 0u);
    for (std::size_t i = 0; i < size; ++i)
        std::swap(indices[i], indices[i + random.below(static_cast<std::uint32_t>(room - i))]);
    indices.resize(size);
    return indices;
}

template <class T>
void check_scatter(std::size_t size, std::size_t room) {
    CAPTURE(size);
    Device& device = test_device();
    const std::vector<T> values = random_values<T>(size, 9);
    const std::vector<std::uint32_t> indices = distinct_indices(size, room);
    const auto in = upload(device, values, "in");
    const auto places = upload(device, indices, "indices");
    const Guarded<T> out(device, room);
    std::vector<T> expected = out.values(); // what is not named by an index stays
    for (std::size_t i = 0; i < size; ++i) expected[indices[i]] = values[i];
    scatter(device, in, places, out.view());
    CHECK(same_bits(out.values(), expected));
    CHECK(out.intact());
}

} // namespace

TEST_CASE_TEMPLATE("scatter: every type and size", T, std::int32_t, std::uint32_t, std::uint64_t, float, cl_float4,
                   Aabb) {
    for (const std::size_t size : boundary_sizes())
        if (size <= 100000) check_scatter<T>(size, size + size / 3);
}

TEST_CASE("scatter: tunings") {
    for (const Tuning& tuning : tunings()) {
        const TuningScope scope(tuning);
        for (const std::size_t size : {1, 63, 64, 65, 5001}) check_scatter<Aabb>(size, size + 9);
    }
}

TEST_CASE("scatter: more than 2^24 elements") {
    if (small_sizes()) return;
    Device& device = test_device();
    const std::uint32_t size = (1u << 24) + 77;
    std::vector<std::uint32_t> places(size);
    for (std::uint32_t i = 0; i < size; ++i) places[i] = size - 1 - i;
    const auto in = upload(device, places, "in");
    const Guarded<std::uint32_t> out(device, size);
    scatter(device, in, in, out.view());
    const std::vector<std::uint32_t> values = out.values();
    std::size_t wrong = 0;
    for (std::uint32_t i = 0; i < size; ++i) wrong += values[i] != i;
    CHECK(wrong == 0);
    CHECK(out.intact());
}

TEST_CASE("scatter: refuses what does not fit") {
    Device& device = test_device();
    auto in = make_buffer<float>(device, 8, "in");
    auto indices = make_buffer<std::uint32_t>(device, 8, "indices");
    auto out = make_buffer<float>(device, 8, "out");
    CHECK_THROWS_AS(scatter(device, in, indices.prefix(7), out), InputError);
    CHECK_THROWS_AS(scatter(device, in, indices, out.prefix(7)), InputError);
}
