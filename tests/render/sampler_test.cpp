// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include <glm/glm.hpp>

#include "bounds/lanes_of.hpp"
#include "runtime/launch.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

namespace {

enum Kind { random_kind, stratified_kind, sobol_kind };

struct Place {
    std::uint32_t pixel, dimension;
};

/// The first `samples` points, which is how many are planned, of each place; with one lane and with eight.
std::vector<std::vector<glm::vec2>> points(Kind kind, std::uint32_t samples, const std::vector<Place>& places,
                                           std::uint64_t seed = test_seed()) {
    Device& device = test_device();
    const std::size_t count = padded(places.size());
    std::vector<std::uint32_t> pixels(count), dimensions(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Place& place = places[std::min(i, places.size() - 1)];
        pixels[i] = place.pixel;
        dimensions[i] = place.dimension;
    }
    std::vector<float> values[2];
    const char* const lanes[2] = {"1", "16"};
    for (int k = 0; k < 2; ++k) {
        const Guarded<float> out(device, 2 * count * samples);
        launch(device,
               {"render/sampler_test.cl", "sampler_test", {{"SAMPLER", std::to_string(kind)}, {"LANES", lanes[k]}}},
               "sampler test", count, seed, upload(device, pixels, "pixels"), upload(device, dimensions, "dimensions"),
               static_cast<std::uint32_t>(count), samples, out.view());
        CHECK(out.intact());
        values[k] = out.values();
    }
    CHECK(same_bits(values[0], values[1]));
    std::vector<std::vector<glm::vec2>> result(places.size(), std::vector<glm::vec2>(samples));
    for (std::size_t i = 0; i < places.size(); ++i)
        for (std::uint32_t s = 0; s < samples; ++s)
            result[i][s] = {values[1][2 * s * count + i], values[1][(2 * s + 1) * count + i]};
    return result;
}

/// Whether the first `count` points lie one in each cell of a grid of columns x rows, columns * rows = count.
bool one_per_cell(const std::vector<glm::vec2>& all, std::uint32_t columns, std::uint32_t rows) {
    std::vector<int> cells(std::size_t{columns} * rows);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const auto x = static_cast<std::uint32_t>(all[i].x * float(columns));
        const auto y = static_cast<std::uint32_t>(all[i].y * float(rows));
        if (++cells[std::size_t{y} * columns + x] > 1) return false;
    }
    return true;
}

} // namespace

TEST_CASE("sampler: points lie in the unit square, uniformly, and depend on nothing but their number") {
    const std::uint32_t count = small_sizes() ? 64 : 4096;
    for (const Kind kind : {random_kind, stratified_kind, sobol_kind}) {
        CAPTURE(kind);
        const auto some = points(kind, count, {{7, 3}, {8, 3}, {7, 4}});
        const std::vector<glm::vec2>& first = some[0];
        glm::dvec2 mean(0.0), square(0.0);
        double product = 0.0;
        int outside = 0;
        for (const glm::vec2& p : first) {
            if (!(p.x >= 0.0f && p.x < 1.0f && p.y >= 0.0f && p.y < 1.0f)) ++outside;
            mean += glm::dvec2(p) / double(count);
            square += glm::dvec2(p * p) / double(count);
            product += double(p.x) * p.y / count;
        }
        CHECK(outside == 0);
        // Variance of x is 1/12, of x^2 4/45, of x y 7/144; five standard deviations of independent points, which the
        // others must not pass either.
        CHECK(std::abs(mean.x - 0.5) < 5 * std::sqrt(1.0 / 12 / count));
        CHECK(std::abs(mean.y - 0.5) < 5 * std::sqrt(1.0 / 12 / count));
        CHECK(std::abs(square.x - 1.0 / 3) < 5 * std::sqrt(4.0 / 45 / count));
        CHECK(std::abs(square.y - 1.0 / 3) < 5 * std::sqrt(4.0 / 45 / count));
        CHECK(std::abs(product - 0.25) < 5 * std::sqrt(7.0 / 144 / count));
        CHECK(points(kind, count, {{7, 3}})[0] == first);
        CHECK(some[1] != first);
        CHECK(some[2] != first);
        CHECK(points(kind, count, {{7, 3}}, test_seed() + 1)[0] != first);
    }
}

TEST_CASE("sampler: pixels, dimensions and coordinates do not go together") {
    // The first point of many pixels and dimensions: correlation of x with y, with the next pixel's and with the next
    // dimension's.
    const std::uint32_t count = small_sizes() ? 16 : 512;
    for (const Kind kind : {random_kind, stratified_kind, sobol_kind}) {
        CAPTURE(kind);
        std::vector<Place> places;
        for (std::uint32_t pixel = 0; pixel <= count; ++pixel)
            for (const std::uint32_t dimension : {0u, 1u}) places.push_back({pixel, dimension});
        const auto all = points(kind, 4, places);
        double with_y = 0.0, with_pixel = 0.0, with_dimension = 0.0;
        for (std::uint32_t pixel = 0; pixel < count; ++pixel) {
            const glm::dvec2 p = glm::dvec2(all[2 * pixel][1]) - 0.5;
            with_y += p.x * p.y;
            with_pixel += p.x * (all[2 * pixel + 2][1].x - 0.5);
            with_dimension += p.x * (all[2 * pixel + 1][1].x - 0.5);
        }
        // Each sum has variance count / 144.
        const double bound = 5 * std::sqrt(count / 144.0);
        CHECK(std::abs(with_y) < bound);
        CHECK(std::abs(with_pixel) < bound);
        CHECK(std::abs(with_dimension) < bound);
    }
}

TEST_CASE("sampler: stratified points lie one in each cell of a grid") {
    // A square, less than a square, 1 and 2, a prime, and more than 2^10 so that the permutation's mask has gaps.
    for (const std::uint32_t count : {1u, 2u, 12u, 13u, 16u, 64u, small_sizes() ? 50u : 1500u}) {
        CAPTURE(count);
        const auto columns = static_cast<std::uint32_t>(std::sqrt(double(count)));
        std::vector<Place> places;
        for (std::uint32_t pixel = 0; pixel < 8; ++pixel) places.push_back({pixel, pixel});
        for (const auto& all : points(stratified_kind, count, places))
            CHECK(one_per_cell(all, columns, count / columns));
    }
}

TEST_CASE("sampler: the cells of stratified points have an order of their own in each dimension") {
    std::set<std::vector<int>> orders;
    std::vector<Place> places;
    for (std::uint32_t dimension = 0; dimension < 16; ++dimension) places.push_back({0, dimension});
    for (const auto& all : points(stratified_kind, 16, places)) {
        std::vector<int> order;
        for (const glm::vec2& p : all) order.push_back(int(p.x * 4) + 4 * int(p.y * 4));
        orders.insert(order);
    }
    CHECK(orders.size() == 16);
}

TEST_CASE("sampler: every prefix of 2^k Sobol points has one in each elementary interval of that size") {
    const std::uint32_t log2 = small_sizes() ? 5 : 10;
    std::vector<Place> places;
    for (std::uint32_t pixel = 0; pixel < 8; ++pixel) places.push_back({pixel, 3 * pixel});
    for (const auto& all : points(sobol_kind, 1u << log2, places))
        for (std::uint32_t k = 0; k <= log2; ++k)
            for (std::uint32_t x = 0; x <= k; ++x) {
                CAPTURE(k);
                CAPTURE(x);
                CHECK(one_per_cell(all, 1u << x, 1u << (k - x)));
            }
}
