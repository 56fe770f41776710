// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "bounds/lanes_of.hpp"
#include "render/ulps.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

namespace {

/// The sine of 2 pi turns, to a few of double's roundings also where it is near zero.
double sine_of(double turns) {
    const double half = turns - 0.5 * std::rint(2 * turns); // exact
    return std::sin(2 * std::numbers::pi * half) * (std::fmod(std::rint(2 * turns), 2.0) == 0.0 ? 1 : -1);
}

double cosine_of(double turns) { return sine_of(turns < 0.75 ? 0.25 + turns : turns - 0.75); }

/// The angles of the points (x, y) by the device.
std::vector<std::array<float, 1>> angles_of(const std::vector<std::array<float, 2>>& points) {
    return in_lanes("render/turn_test.cl", "angle_test", std::vector<std::array<float, 1>>(points.size()), points);
}

} // namespace

TEST_CASE("turn: sine and cosine to the last place") {
    std::vector<std::array<float, 1>> turns;
    // Every 2^-20th (2^-24ths are what samplers give), both sides of every 16th, and down to the smallest denormal.
    const int steps = small_sizes() ? 1 << 7 : 1 << 20;
    for (int i = 0; i <= steps; ++i) turns.push_back({float(i) / float(steps)});
    Random random(test_seed());
    for (int i = 0; i < steps; ++i) turns.push_back({float(random.below(1 << 24)) * 0x1p-24f});
    for (int i = 0; i <= 16; ++i)
        for (const float direction : {-1.0f, 2.0f}) {
            float t = float(i) / 16.0f;
            for (int k = 0; k < 8; ++k)
                if (t >= 0.0f && t <= 1.0f) turns.push_back({t = std::nextafter(t, direction)});
            if (turns.back()[0] < 0.0f || turns.back()[0] > 1.0f) turns.pop_back();
        }
    for (int exponent = -149; exponent < 0; ++exponent)
        for (const float factor : {1.0f, 1.25f, 1.9999999f}) turns.push_back({std::ldexp(factor, exponent)});
    const auto found =
        in_lanes("render/turn_test.cl", "turn_test", std::vector<std::array<float, 2>>(turns.size()), turns);
    double worst[2] = {}, worst_length = 0;
    for (std::size_t i = 0; i < turns.size(); ++i) {
        const double turn = turns[i][0], exact[2] = {sine_of(turn), cosine_of(turn)};
        for (int k = 0; k < 2; ++k) worst[k] = std::max(worst[k], ulps(found[i][k], exact[k]));
        worst_length = std::max(worst_length, std::abs(std::hypot(found[i][0], found[i][1]) - 1) * 0x1p24);
    }
    // The last rounding is half a place. Towards an eighth of a turn, where the values are 0.7 and a place is their
    // roundoff, what is added to the cosine's 1 is 0.29, and its two roundings as much of a place each; to the sine's
    // first term, 0.08, and its three roundings as much each. Polynomials and the smaller roundings are below 0.1.
    CHECK(worst[0] <= 0.9);
    CHECK(worst[1] <= 1.15);
    CHECK(worst_length <= 2.5);
    MESSAGE("worst in units of the last place: sine " << worst[0] << ", cosine " << worst[1] << ", length in roundoffs "
                                                      << worst_length);
}

TEST_CASE("turn: whole quarters are exact") {
    const auto found = in_lanes("render/turn_test.cl", "turn_test", std::vector<std::array<float, 2>>(5),
                                std::vector<std::array<float, 1>>{{0.0f}, {0.25f}, {0.5f}, {0.75f}, {1.0f}});
    const float exact[5][2] = {{0, 1}, {1, 0}, {0, -1}, {-1, 0}, {0, 1}};
    for (int i = 0; i < 5; ++i)
        for (int k = 0; k < 2; ++k) CHECK(found[i][k] == exact[i][k]);
}

TEST_CASE("turn: angles to the last place, at any length of the vector") {
    std::vector<std::array<float, 2>> points;
    Random random(test_seed());
    const auto any_float = [&] {
        for (;;)
            if (const float f = std::bit_cast<float>(std::uint32_t(random.bits())); std::isfinite(f)) return f;
    };
    for (int i = 0; i < (small_sizes() ? 100 : 1 << 19); ++i) {
        points.push_back({any_float(), any_float()}); // most lie beside an axis
        points.push_back({random.uniform(-1, 1), random.uniform(-1, 1)});
        const float x = random.uniform(-1, 1); // beside a diagonal
        points.push_back({x, std::bit_cast<float>(std::bit_cast<std::uint32_t>(x) + random.below(16) - 8)});
        points.push_back({std::ldexp(random.uniform(-1, 1), -130), std::ldexp(random.uniform(-1, 1), -130)});
    }
    const auto found = angles_of(points);
    double worst = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double exact = std::atan2(double(points[i][1]), double(points[i][0])) / std::numbers::pi;
        worst = std::max(worst, ulps(found[i][0], exact));
        if (std::signbit(found[i][0]) != std::signbit(points[i][1])) FAIL_CHECK("sign of point " << i);
    }
    CHECK(worst <= 1.7);
    MESSAGE("worst in units of the last place: " << worst);
}

TEST_CASE("turn: angles on axes, on diagonals and of zeros are exact") {
    const float tiny = std::numeric_limits<float>::denorm_min(), huge = std::numeric_limits<float>::max();
    std::vector<std::array<float, 2>> points{{0.0f, 0.0f}, {0.0f, -0.0f}, {-0.0f, 0.0f}, {-0.0f, -0.0f}};
    std::vector<float> exact{0.0f, -0.0f, 1.0f, -1.0f};
    for (const float r : {tiny, 0x1p-126f, 1.0f, huge}) {
        points.insert(points.end(),
                      {{r, 0.0f}, {r, -0.0f}, {-r, 0.0f}, {-r, -0.0f}, {0.0f, r}, {-0.0f, r}, {0.0f, -r}, {-0.0f, -r}});
        exact.insert(exact.end(), {0.0f, -0.0f, 1.0f, -1.0f, 0.5f, 0.5f, -0.5f, -0.5f});
        points.insert(points.end(), {{r, r}, {-r, r}, {-r, -r}, {r, -r}});
        exact.insert(exact.end(), {0.25f, 0.75f, -0.75f, -0.25f});
    }
    const auto found = angles_of(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        CAPTURE(points[i][0]);
        CAPTURE(points[i][1]);
        CHECK(std::bit_cast<std::uint32_t>(found[i][0]) == std::bit_cast<std::uint32_t>(exact[i]));
    }
}
