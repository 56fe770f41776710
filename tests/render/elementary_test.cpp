// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "render/ulps.hpp"
#include "runtime/launch.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

namespace {

struct Values {
    std::vector<float> logarithms, fractions;
};

Values values_of(const std::vector<float>& numbers) {
    Device& device = test_device();
    const Guarded<float> logarithms(device, numbers.size()), fractions(device, numbers.size());
    launch(device, {"render/elementary_test.cl", "elementary_test"}, "elementary functions", numbers.size(),
           upload(device, numbers, "numbers"), logarithms.view(), fractions.view(),
           static_cast<std::uint32_t>(numbers.size()));
    CHECK(logarithms.intact());
    CHECK(fractions.intact());
    return {logarithms.values(), fractions.values()};
}

/// Positive floats with `steps` per power of two, from the smallest denormal to the largest, both sides of every power
/// of two, and where polynomials change.
std::vector<float> positive_floats(std::uint32_t steps) {
    std::vector<float> numbers;
    const std::uint32_t stride = (1u << 23) / steps;
    for (std::uint32_t bits = 1; bits < 0x7f800000u; bits += stride - (bits & 1u))
        numbers.push_back(std::bit_cast<float>(bits));
    for (int exponent = -149; exponent < 128; ++exponent)
        for (const float factor : {1.0f, 1.41421353f, 1.41421366f, 1.9999999f}) {
            const float number = std::ldexp(factor, exponent);
            for (const float next : {std::nextafter(number, 0.0f), number, std::nextafter(number, 2 * number)})
                if (next > 0.0f && std::isfinite(next)) numbers.push_back(next);
        }
    return numbers;
}

} // namespace

TEST_CASE("elementary: logarithm and absorbed fraction to the last place") {
    std::vector<float> numbers = positive_floats(small_sizes() ? 4 : 1 << 13);
    // The ends of the fraction's intervals, at odd multiples of half of log 2.
    for (int k = 1; k < 48; k += 1) {
        const float end = float((k - 0.5) * std::log(2.0));
        numbers.insert(numbers.end(), {std::nextafter(end, 0.0f), end, std::nextafter(end, 100.0f)});
    }
    Random random(test_seed());
    for (int i = 0; i < (small_sizes() ? 100 : 1 << 20); ++i)
        numbers.push_back(random.uniform(0x1p-24f, i % 2 ? 2.0f : 20.0f));
    const Values found = values_of(numbers);
    double worst_logarithm = 0, worst_fraction = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const double x = numbers[i];
        worst_logarithm = std::max(worst_logarithm, ulps(found.logarithms[i], std::log2(x)));
        worst_fraction = std::max(worst_fraction, ulps(found.fractions[i], -std::expm1(-x)));
    }
    CHECK(worst_logarithm <= 1.0);
    CHECK(worst_fraction <= 1.0);
    MESSAGE("worst in units of the last place: logarithm " << worst_logarithm << ", fraction " << worst_fraction);
}

TEST_CASE("elementary: exact where the value is a float, and at the ends") {
    std::vector<float> powers;
    for (int exponent = -149; exponent < 128; ++exponent) powers.push_back(std::ldexp(1.0f, exponent));
    const Values found = values_of(powers);
    for (std::size_t i = 0; i < powers.size(); ++i) CHECK(found.logarithms[i] == float(int(i) - 149));
    const std::vector<float> fractions =
        values_of({0.0f, 18.0f, 1e30f, std::numeric_limits<float>::infinity()}).fractions;
    CHECK(fractions == std::vector<float>{0.0f, 1.0f, 1.0f, 1.0f});
}
