// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "boxwood/error.hpp"
#include "boxwood/render.hpp"

using namespace boxwood;

TEST_SUITE_BEGIN("render");

namespace {

/// Relative luminance of an sRGB pixel (IEC 61966-2-1).
double luminance(const std::uint8_t* rgb) {
    const double weights[] = {0.2126, 0.7152, 0.0722};
    double sum = 0.0;
    for (int c = 0; c < 3; ++c) {
        const double value = rgb[c] / 255.0;
        sum += weights[c] * (value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
    }
    return sum;
}

Image costs(const std::vector<std::uint32_t>& volumes) {
    return {static_cast<std::uint32_t>(volumes.size()), 1, {{"cost.volumes", volumes}}};
}

} // namespace

TEST_CASE("preview: light is encoded as sRGB and clamped") {
    const std::vector<float> values = {
        0.0f, 1.0f, 0.5f, 0.2158605f, -1.0f, 7.0f, std::numeric_limits<float>::quiet_NaN()};
    const Image image{7, 1, {{"R", values}, {"G", values}, {"B", values}}};
    const std::vector<std::uint8_t> rgb = preview(image, {.exposure = 0.0f, .tone_curve = false});
    // By the transfer function 0.5 has the code 187.5 of 255, and 0.2158605 the code 128.0.
    const std::uint8_t expected[] = {0, 255, 188, 128, 0, 255, 0};
    REQUIRE(rgb.size() == 21);
    for (std::size_t i = 0; i < 7; ++i)
        for (std::size_t c = 0; c < 3; ++c) CHECK(rgb[3 * i + c] == expected[i]);
    CHECK_THROWS_AS(preview(costs({1})), InputError);
}

TEST_CASE("preview: exposure is in stops") {
    const std::vector<float> dark = {0.125f, 0.0625f, 1e-4f}, bright = {0.5f, 0.25f, 4e-4f};
    for (const bool curve : {false, true})
        CHECK(preview({3, 1, {{"R", dark}, {"G", dark}, {"B", bright}}}, {2.0f, curve}) ==
              preview({3, 1, {{"R", bright}, {"G", bright}, {"B", std::vector<float>{2.0f, 1.0f, 1.6e-3f}}}},
                      {0.0f, curve}));
}

TEST_CASE("preview: the tone curve keeps base colours, order and hue, and ends at white") {
    // Under white light of radiance 1 a matt surface of colour c that reflects 4 % more is shown as c.
    const std::vector<float> r = {0.54f, 0.24f, 1e30f, 3.0f, 6.0f}, g = {0.34f, 0.24f, 1e30f, 1.5f, 3.0f},
                             b = {0.14f, 0.24f, 1e30f, 0.5f, 1.0f};
    const std::vector<std::uint8_t> rgb = preview({5, 1, {{"R", r}, {"G", g}, {"B", b}}});
    // 255 times the sRGB transfer function of 0.5, 0.3, 0.1 and 0.2.
    CHECK(std::vector<std::uint8_t>(rgb.begin(), rgb.begin() + 6) ==
          std::vector<std::uint8_t>{188, 149, 89, 124, 124, 124});
    for (int c = 6; c < 9; ++c) CHECK(rgb[c] == 255);
    CHECK(rgb[9] > rgb[10]);
    CHECK(rgb[10] > rgb[11]);
    CHECK(luminance(&rgb[12]) > luminance(&rgb[9]));
    CHECK(rgb[14] > rgb[11]); // brighter is paler
    // Far from what doubles hold, and still no wrapped byte.
    const std::vector<float> most(1, std::numeric_limits<float>::max());
    for (const std::uint8_t value : preview({1, 1, {{"R", most}, {"G", most}, {"B", most}}}, {64.0f, true}))
        CHECK(value == 255);
}

TEST_CASE("preview: the heat map grows lighter with the cost, in equal steps of lightness") {
    std::vector<std::uint32_t> volumes(256);
    for (std::uint32_t i = 0; i < 256; ++i) volumes[i] = i;
    const HeatMap map = cost_preview(costs(volumes));
    REQUIRE(map.rgb.size() == 3 * 256);
    CHECK(map.top == 253); // rank 253 of 0 to 255: 99.5 % of the way, rounded down
    double previous = -1.0;
    for (std::size_t i = 0; i < 253; ++i) {
        const double lightness = std::cbrt(luminance(&map.rgb[3 * i]));
        CHECK(lightness > previous - 0.01); // one code value of rounding in a channel
        previous = lightness;
        // Cube root of luminance is lightness to within the weight of the hue: it stays near the straight line.
        CHECK(std::abs(lightness - (0.12 + 0.84 * static_cast<double>(i) / 253)) < 0.12);
    }
}

TEST_CASE("preview: one expensive pixel does not darken the others; no cost at all is dark") {
    std::vector<std::uint32_t> volumes(1000, 10);
    volumes[5] = 100000;
    const HeatMap map = cost_preview(costs(volumes));
    CHECK(map.top == 10);
    CHECK(luminance(&map.rgb[0]) > 0.6);
    const HeatMap none = cost_preview(costs({0, 0}));
    CHECK(none.top == 0);
    CHECK(luminance(&none.rgb[0]) < 0.02);
    CHECK(cost_preview(costs({})).rgb.empty());
    CHECK_THROWS_AS(cost_preview(Image{}), InputError);
}

TEST_CASE("preview: the suitable exposure follows the light, not the darkness around it") {
    const auto grey = [](std::vector<float> values) {
        return Image{static_cast<std::uint32_t>(values.size()), 1, {{"R", values}, {"G", values}, {"B", values}}};
    };
    CHECK(suitable_exposure(grey({0.3f, 0.3f, 0.3f})) == doctest::Approx(0.0).epsilon(1e-6));
    // Eleven lit pixels: the median is 0.03, the 90th percentile 3. Black pixels and what is not finite do not count.
    std::vector<float> values = {0.01f, 0.01f, 0.02f, 0.02f, 0.02f, 0.03f, 0.3f, 1.0f, 2.0f, 3.0f, 1e30f};
    CHECK(suitable_exposure(grey(values)) == doctest::Approx(0.0).epsilon(1e-6));
    values.insert(values.end(), {0.0f, 0.0f, 0.0f, std::numeric_limits<float>::infinity()});
    CHECK(suitable_exposure(grey(values)) == doctest::Approx(0.0).epsilon(1e-6));
    for (float& value : values) value *= 0x1p-9f;
    CHECK(suitable_exposure(grey(values)) == doctest::Approx(9.0));
    CHECK(suitable_exposure(grey({0.0f, 0.0f})) == 0.0f);
    CHECK_THROWS_AS(suitable_exposure(Image{}), InputError);
}

TEST_CASE("preview: a channel that is shorter or longer than the picture is refused by name") {
    const std::vector<float> four(4, 0.5f);
    for (const std::size_t size : {0u, 3u, 5u}) {
        const std::vector<float> other(size, 0.5f);
        for (std::size_t wrong = 0; wrong < 3; ++wrong) {
            Image image{2, 2, {{"R", four}, {"G", four}, {"B", four}}};
            image.channels[wrong].samples = other;
            const auto names = doctest::Contains(image.channels[wrong].name.c_str());
            CHECK_THROWS_WITH_AS(preview(image), names, InputError);
            CHECK_THROWS_WITH_AS(suitable_exposure(image), names, InputError);
        }
        const Image image{2, 2, {{"cost.volumes", std::vector<std::uint32_t>(size, 1)}}};
        CHECK_THROWS_WITH_AS(cost_preview(image), doctest::Contains("cost.volumes"), InputError);
    }
}
