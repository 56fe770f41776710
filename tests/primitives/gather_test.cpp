// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "boxwood/error.hpp"
#include "boxwood/gather.hpp"
#include "primitives/primitives_support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("primitives");

namespace {

template <class T>
void check_gather(std::size_t in_size, std::size_t size) {
    CAPTURE(size);
    Device& device = test_device();
    Random random(size);
    const std::vector<T> values = random_values<T>(in_size, 8);
    std::vector<std::uint32_t> indices(size); // with repeats
    for (std::uint32_t& index : indices) index = random.below(static_cast<std::uint32_t>(in_size));
    std::vector<T> expected(size);
    for (std::size_t i = 0; i < size; ++i) expected[i] = values[indices[i]];

    const auto in = upload(device, values, "in");
    const auto places = upload(device, indices, "indices");
    const Guarded<T> out(device, size);
    gather(device, in, places, out.view());
    CHECK(same_bits(out.values(), expected));
    CHECK(out.intact());
}

} // namespace

TEST_CASE_TEMPLATE("gather: every type and size", T, std::int32_t, std::uint32_t, std::uint64_t, float, cl_float4,
                   Aabb) {
    for (const std::size_t size : boundary_sizes())
        if (size <= 100000) check_gather<T>(777, size);
}

TEST_CASE("gather: tunings") {
    for (const Tuning& tuning : tunings()) {
        const TuningScope scope(tuning);
        for (const std::size_t size : {1, 63, 64, 65, 5001}) check_gather<Aabb>(777, size);
    }
}

TEST_CASE("gather: more than 2^24 elements") {
    if (small_sizes()) return;
    check_gather<std::uint32_t>((std::size_t{1} << 24) + 5, (std::size_t{1} << 24) + 77);
}

TEST_CASE("gather: refuses what does not fit") {
    Device& device = test_device();
    auto in = make_buffer<float>(device, 8, "in");
    auto indices = make_buffer<std::uint32_t>(device, 8, "indices");
    auto out = make_buffer<float>(device, 7, "out");
    CHECK_THROWS_AS(gather(device, in, indices, out), InputError);
}
