// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "boxwood/error.hpp"
#include "render/film.hpp"
#include "runtime/launch.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

namespace {

constexpr FilmParts whole{1, false};
constexpr FilmParts parts{3, true};

/// A film of `pixels` pixels to which samples are added.
struct TestFilm {
    Device& device = test_device();
    FilmParts what;
    std::uint32_t pixels;
    Buffer<float> film;

    TestFilm(FilmParts of, std::uint32_t count) : what(of), pixels(count), film(make_film(device, of, count)) {}

    /// `light`: 3 floats for each part of each pixel, part after part; `ao`: one per pixel.
    void add(const std::vector<float>& light, const std::vector<float>& ao = {}, std::uint32_t first = 0) {
        const std::size_t count = light.size() / 3 / what.lights;
        std::array<Buffer<float>, 3> buffers;
        FilmSample sample{{}, {}, first, static_cast<std::uint32_t>(count)};
        for (std::uint32_t k = 0; k < what.lights; ++k) {
            const auto begin = light.begin() + static_cast<std::ptrdiff_t>(3 * count * k);
            buffers[k] =
                upload(device, std::vector<float>(begin, begin + static_cast<std::ptrdiff_t>(3 * count)), "light");
            sample.lights[k] = buffers[k];
        }
        Buffer<float> share;
        if (what.ao) {
            share = upload(device, ao, "ao");
            sample.ao = share;
        }
        add_sample(device, what, sample, film);
        device.finish();
    }
    std::vector<float> values() const { return download(device, film); }
};

double luminance(double r, double g, double b) { return 0.2126 * r + 0.7152 * g + 0.0722 * b; }

} // namespace

TEST_CASE("film: means, variance and counts are those of double precision") {
    // 301 pixels: more than a slice of the smallest tuning, and odd. Samples of 8 magnitudes.
    const std::uint32_t pixels = small_sizes() ? 5 : 301, samples = 9;
    TestFilm film(parts, pixels);
    Random random(1);
    std::vector<std::vector<double>> sums(10, std::vector<double>(pixels));
    std::vector<std::vector<double>> y(pixels);
    for (std::uint32_t s = 0; s < samples; ++s) {
        std::vector<float> light(9 * pixels), ao(pixels);
        for (float& value : light) value = std::exp(random.uniform(-10.0f, 10.0f));
        for (float& value : ao) value = random.uniform(0.0f, 1.0f);
        film.add(light, ao);
        for (std::uint32_t i = 0; i < pixels; ++i) {
            double seen[3] = {};
            for (std::uint32_t k = 0; k < 9; ++k) {
                const double value = light[(k / 3 * pixels + i) * 3 + k % 3];
                sums[k][i] += value;
                seen[k % 3] += value;
            }
            sums[9][i] += double{ao[i]};
            y[i].push_back(luminance(seen[0], seen[1], seen[2]));
        }
    }
    const std::vector<float> values = film.values();
    const auto means = film_means(parts, film.pixels, values);
    const auto variance = film_variance(parts, film.pixels, values);
    REQUIRE(means.size() == 10);
    for (std::uint32_t i = 0; i < pixels; ++i) {
        for (std::size_t k = 0; k < 10; ++k)
            CHECK(std::abs(means[k][i] - sums[k][i] / samples) <= 0x1p-23 * sums[k][i] / samples);
        double mean = 0.0, squares = 0.0;
        for (const double value : y[i]) mean += value / samples;
        for (const double value : y[i]) squares += (value - mean) * (value - mean);
        CHECK(std::abs(variance[i] - squares / (samples - 1) / samples) <= 1e-5 * squares);
        CHECK(film_samples(parts, film.pixels, values)[i] == samples);
    }
}

TEST_CASE("film: many samples of one brightness lose no digits, and their variance none to cancellation") {
    // Plain float sums of 4000 equal values are off by up to 2^-13 of them. The second pixel alternates around 1000 by
    // 1/64: its variance from sums of squares would have no digit left.
    const std::uint32_t samples = small_sizes() ? 64 : 4000;
    TestFilm film(whole, 2);
    for (std::uint32_t s = 0; s < samples; ++s) {
        const float around = 1000.0f + (s % 2 ? 0x1p-6f : -0x1p-6f);
        film.add({0.1f, 0.1f, 0.1f, around, around, around});
    }
    const std::vector<float> values = film.values();
    const auto means = film_means(whole, film.pixels, values);
    CHECK(means[0][0] == 0.1f);
    CHECK(film_variance(whole, film.pixels, values)[0] < 1e-12f);
    const double expected = 0x1p-12 / (samples - 1);
    CHECK(std::abs(film_variance(whole, film.pixels, values)[1] - expected) < 0.02 * expected);
}

TEST_CASE("film: what is no light never enters") {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    constexpr float most = std::numeric_limits<float>::max();
    const std::vector<float> bad = {nan, inf, -inf, -1e-30f, most};
    TestFilm film(whole, static_cast<std::uint32_t>(3 * bad.size()));
    const std::vector<float> good(9 * bad.size(), most / 2); // so that `most` would pass the range of the sum
    film.add(good);
    for (std::size_t c = 0; c < 3; ++c) { // in each component, of other pixels
        std::vector<float> light(9 * bad.size(), 0.0f);
        for (std::size_t i = 0; i < bad.size(); ++i) light[3 * (c * bad.size() + i) + c] = bad[i];
        film.add(light);
    }
    const std::vector<float> values = film.values();
    for (const float value : values) CHECK(std::isfinite(value));
    // The first sample, and two of three others.
    for (const std::uint32_t count : film_samples(whole, film.pixels, values)) CHECK(count == 3);

    TestFilm shares(parts, 2);
    shares.add(std::vector<float>(18, 1.0f), {nan, 0.5f});
    CHECK(film_samples(parts, shares.pixels, shares.values()) == std::vector<std::uint32_t>{0, 1});
    CHECK(film_means(parts, shares.pixels, shares.values())[0] == std::vector<float>{0.0f, 1.0f});
    CHECK(film_variance(parts, shares.pixels, shares.values())[1] == inf);
}

TEST_CASE("film: a batch adds to its own pixels") {
    TestFilm film(whole, 7);
    film.add({1, 2, 3, 4, 5, 6}, {}, 4);
    const auto means = film_means(whole, film.pixels, film.values());
    CHECK(means[0] == std::vector<float>{0, 0, 0, 0, 1, 4, 0});
    CHECK(means[2] == std::vector<float>{0, 0, 0, 0, 3, 6, 0});
}

TEST_CASE("film: one pixel at a time and eight give the same bytes, wherever a batch begins") {
    constexpr std::uint32_t pixels = 43; // packets of 8, the last one not full
    struct Batch {
        std::uint32_t first, count;
    };
    constexpr Batch batches[] = {{0, pixels}, {3, 2}, {5, 11}, {16, 8}, {39, 4}};
    Device& device = test_device();
    Random random(2);
    std::vector<float> light(3 * pixels), ao(pixels);
    for (float& value : light) value = random.uniform(0.0f, 8.0f);
    for (float& value : ao) value = random.uniform(0.0f, 1.0f);
    light[3 * 10] = -1.0f; // of each batch's pixel 10
    const auto samples = upload(device, light, "light"), shares = upload(device, ao, "ao");
    std::vector<std::uint32_t> expected(pixels);
    for (const Batch& batch : batches)
        for (std::uint32_t i = 0; i < batch.count; ++i) expected[batch.first + i] += i == 10 ? 0 : 1;

    for (const FilmParts what : {whole, FilmParts{2, false}, parts}) {
        std::vector<std::vector<float>> films;
        for (const std::uint32_t lanes : {1u, 8u}) {
            TestFilm film(what, pixels);
            const Defines defines{
                {"LIGHTS", std::to_string(what.lights)}, {"AO", what.ao ? "1" : "0"}, {"LANES", std::to_string(lanes)}};
            for (const Batch& batch : batches) {
                const Slices slices = cut(device, batch.count + batch.first % lanes, lanes);
                launch(device, {"render/film.cl", "film_add", defines}, "film add", slices.slices, samples, samples,
                       samples, shares, batch.first, batch.count, slices.length, film.film);
            }
            films.push_back(film.values());
            CHECK(film_samples(what, pixels, films.back()) == expected);
        }
        CHECK(films[0] == films[1]);
    }
}

TEST_CASE("film: pixels at once are those of the tuning, whatever the device, and the bits are the same") {
    Device device(std::to_string(test_device().info().index)); // with no program compiled yet
    const std::vector<float> light(3 * 21, 0.1f);
    std::vector<std::vector<float>> films;
    for (const std::uint32_t lanes : {16u, 1u, 8u}) {
        Tuning tuning = device.tuning();
        tuning.lanes = lanes;
        device.set_tuning(tuning);
        Buffer<float> film = make_film(device, whole, 21);
        const double before = device.compile_ms();
        const Buffer<float> sample = upload(device, light, "light");
        add_sample(device, whole, {{sample}, {}, 0, 21}, film);
        device.finish();
        CHECK((device.compile_ms() > before) == (lanes != 8)); // eight of 16 and of 8 lanes, and one: two programs
        films.push_back(download(device, film));
        CHECK(same_bits(films.front(), films.back()));
    }
}

TEST_CASE("film: what does not fit is refused before it is made") {
    const Device& device = test_device();
    CHECK_THROWS_AS(check_film(device, {.light = {}, .width = 65536, .height = 65536, .aovs = {}}), CapacityError);
    CHECK_THROWS_AS(check_film(device, {.light = {}, .width = 1u << 23, .height = 1u << 23, .aovs = {}}),
                    CapacityError);
    CHECK_NOTHROW(check_film(device, {.light = {}, .width = 64, .height = 64, .aovs = {}}));
}

TEST_CASE("film: what a picture takes beside the film counts where the device's memory is the host's") {
    const RenderOptions options{.light = {}, .width = 64, .height = 64, .aovs = {}};
    constexpr std::uint64_t film = 15 * 4096 * sizeof(float); // two parts of light, their losses, three moments
    DeviceInfo device;
    device.largest_buffer_bytes = device.global_bytes = film;
    CHECK_NOTHROW(check_film(device, options));
    device.cpu = true;
    CHECK_THROWS_AS(check_film(device, options), CapacityError);
    device.global_bytes = 3 * film; // a checkpoint: the film and its bytes
    CHECK_NOTHROW(check_film(device, options));
    RenderOptions many = options;
    many.aovs = all_aovs();
    CHECK_THROWS_AS(check_film(device, many), CapacityError);
    device.largest_buffer_bytes = film - 1;
    CHECK_THROWS_AS(check_film(device, options), CapacityError);
}

TEST_SUITE_END();
