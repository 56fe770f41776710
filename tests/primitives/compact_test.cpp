// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "boxwood/compact.hpp"
#include "boxwood/error.hpp"
#include "primitives/primitives_support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("primitives");

namespace {

/// Keeps about `percent` of the elements; flags are any value but 0. The rest of the output must stay as it was.
template <class T>
void check_compact(std::size_t size, std::uint32_t percent) {
    CAPTURE(size);
    CAPTURE(percent);
    Device& device = test_device();
    Random random(size + percent);
    const std::vector<T> values = random_values<T>(size, 10);
    std::vector<std::uint32_t> keep(size);
    for (std::uint32_t& flag : keep) flag = random.below(100) < percent ? 0x80000000u >> random.below(32) : 0u;

    const auto in = upload(device, values, "in");
    const auto flags = upload(device, keep, "flags");
    const Guarded<T> out(device, size);
    const Guarded<std::uint32_t> count(device, 1);
    std::vector<T> expected = out.values();
    std::uint32_t kept = 0;
    for (std::size_t i = 0; i < size; ++i)
        if (keep[i] != 0) expected[kept++] = values[i];
    compact(device, in, flags, out.view(), count.view());
    CHECK(count.values()[0] == kept);
    CHECK(same_bits(out.values(), expected));
    CHECK(out.intact());
    CHECK(count.intact());
}

} // namespace

TEST_CASE_TEMPLATE("compact: every type and size", T, std::int32_t, std::uint32_t, std::uint64_t, float, cl_float4,
                   Aabb) {
    for (const std::size_t size : boundary_sizes())
        if (size <= 100000) check_compact<T>(size, 40);
}

TEST_CASE("compact: all, none and few") {
    for (const std::size_t size : {1, 64, 5001})
        for (const std::uint32_t percent : {0u, 1u, 99u, 100u}) check_compact<std::uint32_t>(size, percent);
}

TEST_CASE("compact: tunings") {
    for (const Tuning& tuning : tunings()) {
        const TuningScope scope(tuning);
        for (const std::size_t size : {0, 1, 63, 64, 65, 5001, 30011})
            for (const std::uint32_t percent : {2u, 50u}) check_compact<Aabb>(size, percent);
    }
}

TEST_CASE("compact: more than 2^24 elements") {
    if (small_sizes()) return;
    check_compact<std::uint32_t>((std::size_t{1} << 24) + 77, 50);
}

TEST_CASE("compact: refuses what does not fit") {
    Device& device = test_device();
    auto in = make_buffer<float>(device, 8, "in");
    auto flags = make_buffer<std::uint32_t>(device, 8, "flags");
    auto out = make_buffer<float>(device, 8, "out");
    auto count = make_buffer<std::uint32_t>(device, 1, "count");
    CHECK_THROWS_AS(compact(device, in, flags.prefix(7), out, count), InputError);
    CHECK_THROWS_AS(compact(device, in, flags, out.prefix(7), count), InputError);
    CHECK_THROWS_AS(compact(device, in, flags, out, count.prefix(0)), InputError);
}

TEST_CASE("compact: memory does not depend on the number of threads") {
    Device& device = test_device();
    // From so many elements on that the counts of slices take tiles to scan.
    for (const std::size_t size : {5001u, small_sizes() ? 1u : 1000003u}) {
        CAPTURE(size);
        const auto in = upload(device, random_values<float>(size, 13), "in");
        const auto flags = upload(device, random_values<std::uint32_t>(size, 14), "flags");
        auto out = make_buffer<float>(device, size, "out");
        auto count = make_buffer<std::uint32_t>(device, 1, "count");
        check_memory_by_compute_units([&] { compact(device, in, flags, out, count); });
    }
}
