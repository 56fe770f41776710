// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "boxwood/error.hpp"
#include "boxwood/reduce.hpp"
#include "primitives/fold_oracle.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("primitives");

namespace {

template <class T>
std::vector<T> reduced(const std::vector<T>& values, Operator op) {
    Device& device = test_device();
    const Buffer<T> in = upload(device, values, "values");
    const Guarded<T> out(device, 1);
    reduce(device, in, op, out.view());
    CHECK(out.intact());
    return out.values();
}

} // namespace

TEST_CASE_TEMPLATE("reduce: every type, operator and size", T, std::int32_t, std::uint32_t, std::uint64_t, float,
                   cl_float4, Aabb) {
    for (const Operator op : operators<T>()) {
        CAPTURE(static_cast<int>(op));
        for (const std::size_t size : boundary_sizes()) {
            CAPTURE(size);
            const std::vector<T> values = random_values<T>(size, size + 1);
            check_fold(reduced(values, op)[0], values, 0, size, op);
        }
    }
}

TEST_CASE_TEMPLATE("reduce: the tuning does not change a bit", T, float, Aabb) {
    for (const std::size_t size : boundary_sizes()) {
        CAPTURE(size);
        const std::vector<T> values = random_values<T>(size, size + 2);
        const std::vector<T> expected = reduced(values, Operator::sum);
        for (const Tuning& tuning : tunings()) {
            const TuningScope scope(tuning);
            CHECK(same_bits(reduced(values, Operator::sum), expected));
        }
    }
}

TEST_CASE("reduce: more than 2^24 elements, and sums that a running float sum would lose") {
    if (small_sizes()) return;
    const std::size_t size = (std::size_t{1} << 24) + 4099;
    CHECK(reduced(std::vector<std::uint32_t>(size, 3u), Operator::sum)[0] == 3u * size);
    // 2^24 + 1 is no float: one after the other the ones would stop counting at 2^24.
    CHECK(reduced(std::vector<float>(size, 1.0f), Operator::sum)[0] == doctest::Approx(double(size)).epsilon(1e-6));
}

TEST_CASE("reduce: the only element that matters is found wherever it is") {
    const std::size_t size = 3 * tile + 70;
    for (std::size_t place = 0; place < size; place += small_sizes() ? 1009 : 61) {
        std::vector<std::uint32_t> values(size, 5u);
        values[place] = 9u;
        CHECK(reduced(values, Operator::max)[0] == 9u);
        values[place] = 1u;
        CHECK(reduced(values, Operator::min)[0] == 1u);
    }
}

TEST_CASE("reduce: refuses what does not fit") {
    Device& device = test_device();
    auto boxes = make_buffer<Aabb>(device, 2, "boxes");
    auto numbers = make_buffer<float>(device, 2, "numbers");
    CHECK_THROWS_AS(reduce(device, boxes, Operator::min, boxes.view()), InputError);
    CHECK_THROWS_AS(reduce(device, numbers, Operator::sum, BufferView<float>()), InputError);
}
