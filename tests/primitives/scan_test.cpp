// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "boxwood/error.hpp"
#include "boxwood/scan.hpp"
#include "primitives/fold_oracle.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("primitives");

namespace {

template <class T>
std::vector<T> scanned(const std::vector<T>& values, Operator op, bool inclusive) {
    Device& device = test_device();
    const Buffer<T> in = upload(device, values, "values");
    const Guarded<T> out(device, values.size());
    if (inclusive)
        inclusive_scan<T>(device, in, op, out.view());
    else
        exclusive_scan<T>(device, in, op, out.view());
    CHECK(out.intact());
    return out.values();
}

template <class T>
void check_scan(const std::vector<T>& values, const std::vector<T>& actual, Operator op, bool inclusive) {
    REQUIRE(actual.size() == values.size());
    Oracle<T> oracle(op);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (inclusive) oracle.add(values[i]);
        wrong += !oracle.accepts(actual[i]);
        if (!inclusive) oracle.add(values[i]);
    }
    CHECK(wrong == 0);
}

} // namespace

TEST_CASE_TEMPLATE("scan: every type, operator and size", T, std::int32_t, std::uint32_t, std::uint64_t, float,
                   cl_float4) {
    for (const Operator op : operators<T>()) {
        CAPTURE(static_cast<int>(op));
        for (const bool inclusive : {false, true}) {
            CAPTURE(inclusive);
            for (const std::size_t size : boundary_sizes()) {
                CAPTURE(size);
                const std::vector<T> values = random_values<T>(size, size + 3);
                check_scan(values, scanned(values, op, inclusive), op, inclusive);
            }
        }
    }
}

TEST_CASE("scan: the tuning does not change a bit") {
    for (const std::size_t size : boundary_sizes()) {
        CAPTURE(size);
        const std::vector<float> values = random_values<float>(size, size + 4);
        const std::vector<float> expected = scanned(values, Operator::sum, false);
        for (const Tuning& tuning : tunings()) {
            const TuningScope scope(tuning);
            CHECK(same_bits(scanned(values, Operator::sum, false), expected));
        }
    }
}

TEST_CASE("scan: in place") {
    Device& device = test_device();
    const std::vector<std::uint32_t> values = random_values<std::uint32_t>(5001, 6);
    const auto buffer = upload(device, values, "values");
    exclusive_scan<std::uint32_t>(device, buffer, Operator::sum, buffer);
    check_scan(values, download(device, buffer), Operator::sum, false);
}

TEST_CASE("scan: more than 2^24 elements") {
    if (small_sizes()) return;
    const std::vector<std::uint32_t> values = random_values<std::uint32_t>((std::size_t{1} << 24) + 4099, 7);
    check_scan(values, scanned(values, Operator::sum, false), Operator::sum, false);
}

TEST_CASE("scan: refuses what does not fit") {
    Device& device = test_device();
    const auto in = make_buffer<float>(device, 8, "in");
    const auto out = make_buffer<float>(device, 7, "out");
    CHECK_THROWS_AS(exclusive_scan<float>(device, in, Operator::sum, out), InputError);
    CHECK_THROWS_AS(inclusive_scan<float>(device, in, Operator::sum, out), InputError);
}
