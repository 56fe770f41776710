// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>

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
        inclusive_scan(device, in, op, out.view());
    else
        exclusive_scan(device, in, op, out.view());
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

/// Uniform, zeros of either sign among them, or of sizes far apart.
template <class T>
std::vector<T> not_negative_values(std::size_t size, int kind) {
    Random random(size + kind);
    std::vector<T> values(size);
    auto* const floats = reinterpret_cast<float*>(values.data());
    for (std::size_t i = 0; i < size * sizeof(T) / sizeof(float); ++i) {
        const float value = random.uniform(0.0f, 1.0f);
        const std::uint32_t choice = random.below(4);
        if (kind == 0)
            floats[i] = value;
        else if (kind == 1)
            floats[i] = choice == 0 ? 0.0f : choice == 1 ? -0.0f : value;
        else
            floats[i] = std::ldexp(value, -16 * static_cast<int>(choice));
    }
    return values;
}

/// How often a component is smaller than that of the element before.
template <class T>
std::size_t falls(const std::vector<T>& values) {
    constexpr std::size_t components = sizeof(T) / sizeof(float);
    const auto* const floats = reinterpret_cast<const float*>(values.data());
    std::size_t count = 0;
    for (std::size_t i = components; i < values.size() * components; ++i) count += floats[i] < floats[i - components];
    return count;
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

// From several tiles up to three levels of them: within a step, from tile to tile, and from what is before a tile of
// tiles.
TEST_CASE_TEMPLATE("scan: sums of what is not negative never fall", T, float, cl_float4) {
    std::vector<std::size_t> sizes = boundary_sizes();
    if (!small_sizes()) sizes.push_back((std::size_t{1} << 24) / (sizeof(T) / sizeof(float)) + 4099);
    for (const std::size_t size : sizes) {
        CAPTURE(size);
        for (const int kind : {0, 1, 2}) {
            CAPTURE(kind);
            const std::vector<T> values = not_negative_values<T>(size, kind);
            for (const bool inclusive : {false, true}) {
                const std::vector<T> sums = scanned(values, Operator::sum, inclusive);
                CHECK(falls(sums) == 0);
                check_scan(values, sums, Operator::sum, inclusive);
            }
        }
    }
}

TEST_CASE("scan: tiles without negative elements among others are as exact as these") {
    const std::size_t size = small_sizes() ? 4 * tile : tile * tile + 5 * tile;
    for (const bool inclusive : {false, true}) {
        std::vector<float> values = random_values<float>(size, 11);
        for (std::size_t i = 0; i < size; ++i)
            if (i / tile % 3 != 0) values[i] = i / tile % 3 == 1 ? std::abs(values[i]) : -std::abs(values[i]);
        check_scan(values, scanned(values, Operator::sum, inclusive), Operator::sum, inclusive);
    }
}

TEST_CASE("scan: the tuning does not change a bit") {
    for (const std::size_t size : boundary_sizes()) {
        CAPTURE(size);
        for (const bool inclusive : {false, true}) {
            for (const std::vector<float>& values :
                 {random_values<float>(size, size + 4), not_negative_values<float>(size, 0)}) {
                const std::vector<float> expected = scanned(values, Operator::sum, inclusive);
                for (const Tuning& tuning : tunings()) {
                    const TuningScope scope(tuning);
                    CHECK(same_bits(scanned(values, Operator::sum, inclusive), expected));
                }
            }
        }
    }
}

TEST_CASE("scan: in place") {
    Device& device = test_device();
    const std::vector<std::uint32_t> values = random_values<std::uint32_t>(5001, 6);
    auto buffer = upload(device, values, "values");
    exclusive_scan(device, buffer, Operator::sum, buffer);
    check_scan(values, download(device, buffer), Operator::sum, false);
}

TEST_CASE("scan: more than 2^24 elements") {
    if (small_sizes()) return;
    const std::vector<std::uint32_t> values = random_values<std::uint32_t>((std::size_t{1} << 24) + 4099, 7);
    check_scan(values, scanned(values, Operator::sum, false), Operator::sum, false);
}

TEST_CASE("scan: refuses what does not fit") {
    Device& device = test_device();
    auto in = make_buffer<float>(device, 8, "in");
    auto out = make_buffer<float>(device, 7, "out");
    CHECK_THROWS_AS(exclusive_scan(device, in, Operator::sum, out), InputError);
    CHECK_THROWS_AS(inclusive_scan(device, in, Operator::sum, out), InputError);
}
