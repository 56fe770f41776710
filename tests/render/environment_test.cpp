// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "bounds/lanes_of.hpp"
#include "boxwood/error.hpp"
#include "boxwood/material.hpp"
#include "render/environment.hpp"
#include "runtime/launch.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

namespace {

constexpr double pi = std::numbers::pi;

struct Answers {
    std::vector<glm::dvec4> lookups; ///< Radiance and density of each direction.
    std::vector<glm::dvec4> drawn;   ///< Direction and density of each point.
    std::vector<glm::dvec3> light;   ///< And its radiance.
};

Answers ask(const Environment& environment, const std::vector<glm::vec3>& directions,
            const std::vector<glm::vec2>& points, bool compensated = false) {
    Device& device = test_device();
    const EnvironmentMap map = upload_environment(device, environment);
    std::vector<std::array<float, 3>> d(std::max(directions.size(), points.size()), {0, 1, 0});
    std::vector<std::array<float, 2>> p(d.size(), {0, 0});
    for (std::size_t i = 0; i < directions.size(); ++i) d[i] = {directions[i].x, directions[i].y, directions[i].z};
    for (std::size_t i = 0; i < points.size(); ++i) p[i] = {points[i].x, points[i].y};
    const std::size_t count = padded(d.size());
    const std::string kind = map.kind == EnvironmentKind::picture ? "2" : "1";
    std::vector<float> a[2], b[2];
    for (const int k : {0, 1}) {
        const Guarded<float> out(device, 4 * count), drawn(device, 7 * count);
        launch(device,
               {"render/environment_test.cl",
                "environment_test",
                {{"ENVIRONMENT", kind}, {"COMPENSATED", compensated ? "1" : "0"}, {"LANES", k == 0 ? "1" : "16"}}},
               "environment test", count, map.record, map.texels, compensated ? map.rows_above_floor : map.rows,
               compensated ? map.columns_above_floor : map.columns, upload(device, by_components(d), "directions"),
               upload(device, by_components(p), "points"), static_cast<std::uint32_t>(count), out.view(), drawn.view());
        CHECK(out.intact());
        CHECK(drawn.intact());
        a[k] = out.values();
        b[k] = drawn.values();
    }
    CHECK(same_bits(a[0], a[1]));
    CHECK(same_bits(b[0], b[1]));
    const auto of = [&](const std::vector<float>& values, std::size_t component, std::size_t i) {
        return double(values[component * count + i]);
    };
    Answers answers;
    for (std::size_t i = 0; i < directions.size(); ++i)
        answers.lookups.emplace_back(of(a[1], 0, i), of(a[1], 1, i), of(a[1], 2, i), of(a[1], 3, i));
    for (std::size_t i = 0; i < points.size(); ++i) {
        answers.drawn.emplace_back(of(b[1], 0, i), of(b[1], 1, i), of(b[1], 2, i), of(b[1], 3, i));
        answers.light.emplace_back(of(b[1], 4, i), of(b[1], 5, i), of(b[1], 6, i));
    }
    return answers;
}

/// Direction of the place (x, y) of a picture, in texels: include/boxwood/environment.hpp in double precision.
glm::dvec3 direction_of(const Environment& e, double x, double y) {
    const double theta = pi * y / e.height, phi = 2 * pi * (x / e.width - 0.5);
    return {std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
}

/// A picture of random texels over four orders of magnitude, a third of them black but not the first.
Environment random_environment(std::uint32_t width, std::uint32_t height) {
    Random random(31);
    Environment e;
    e.width = width;
    e.height = height;
    for (std::uint32_t i = 0; i < width * height; ++i) {
        const float value = random.below(3) == 0 && i > 0 ? 0.0f : std::exp(random.uniform(-5, 5));
        e.pixels.emplace_back(value, 0.5f * value, random.uniform(0, 1) * value);
    }
    return e;
}

double luminance(const glm::dvec3& c) { return glm::dot(c, glm::dvec3(0.2126, 0.7152, 0.0722)); }

std::vector<glm::vec2> grid_points(int across) {
    std::vector<glm::vec2> points;
    for (int j = 0; j < across; ++j)
        for (int i = 0; i < across; ++i) points.emplace_back((i + 0.5) / across, (j + 0.5) / across);
    return points;
}

} // namespace

TEST_CASE("environment: axes and centres of texels") {
    const Environment e = random_environment(8, 4);
    // +x is between the two middle columns, +z three quarters across.
    std::vector<glm::vec3> directions;
    for (std::uint32_t y = 0; y < e.height; ++y)
        for (std::uint32_t x = 0; x < e.width; ++x) directions.push_back(direction_of(e, x + 0.5, y + 0.5));
    directions.insert(directions.end(), {{1, 0, 0}, {0, 0, 1}, {-1, 0, 0}});
    const Answers answers = ask(e, directions, {});
    const auto near = [](const glm::dvec4& found, const glm::dvec3& wanted) {
        return glm::length(glm::dvec3(found) - wanted) <= 1e-4 * (glm::length(wanted) + 1.0);
    };
    const auto pixel = [&](int x, int y) { return glm::dvec3(e.pixels[y * 8 + x]); };
    for (std::size_t i = 0; i < e.pixels.size(); ++i) CHECK(near(answers.lookups[i], e.pixels[i]));
    CHECK(near(answers.lookups[32], (pixel(3, 1) + pixel(4, 1) + pixel(3, 2) + pixel(4, 2)) / 4.0));
    CHECK(near(answers.lookups[33], (pixel(5, 1) + pixel(6, 1) + pixel(5, 2) + pixel(6, 2)) / 4.0));
    CHECK(near(answers.lookups[34], (pixel(0, 1) + pixel(7, 1) + pixel(0, 2) + pixel(7, 2)) / 4.0));
}

TEST_CASE("environment: a rotation turns the picture about +y, counter-clockwise as seen from above") {
    const Environment e = random_environment(8, 4);
    for (const double angle : {0.5 * pi, -0.3, 2.0 * pi + 1.0}) {
        CAPTURE(angle);
        Environment turned = e;
        turned.rotation = static_cast<float>(angle);
        std::vector<glm::vec3> directions, there;
        const glm::dmat3 turn(glm::dvec3(std::cos(angle), 0, -std::sin(angle)), glm::dvec3(0, 1, 0),
                              glm::dvec3(std::sin(angle), 0, std::cos(angle)));
        for (std::uint32_t y = 0; y < e.height; ++y)
            for (std::uint32_t x = 0; x < e.width; ++x) {
                const glm::dvec3 direction = direction_of(e, x + 0.3, y + 0.6);
                directions.emplace_back(direction);
                there.emplace_back(turn * direction);
            }
        const std::vector<glm::vec2> points = grid_points(8);
        const Answers straight = ask(e, directions, points), answers = ask(turned, there, points);
        for (std::size_t i = 0; i < directions.size(); ++i)
            CHECK(glm::length(answers.lookups[i] - straight.lookups[i]) <=
                  1e-4 * (glm::length(straight.lookups[i]) + 1));
        for (std::size_t i = 0; i < points.size(); ++i) {
            CHECK(glm::length(glm::dvec3(answers.drawn[i]) - turn * glm::dvec3(straight.drawn[i])) <= 1e-5);
            CHECK(answers.drawn[i].w == straight.drawn[i].w);
            CHECK(answers.light[i] == straight.light[i]);
        }
    }
    Environment wrong = e;
    wrong.rotation = std::numeric_limits<float>::infinity();
    CHECK_THROWS_AS(upload_environment(test_device(), wrong), InputError);
}

TEST_CASE("environment: the density integrates to 1, is that of what is drawn, and is nowhere 0 where there is light") {
    const int across = small_sizes() ? 16 : 256;
    for (const int variant : {0, 1, 2, 3, 4, 5}) {
        const glm::uvec2 size = std::array{glm::uvec2(16, 8), glm::uvec2(5, 3), glm::uvec2(1, 1)}[variant / 2];
        const bool compensated = variant % 2 == 1;
        CAPTURE(size.x);
        CAPTURE(compensated);
        const Environment e = random_environment(size.x, size.y);
        // A grid over both angles, whose azimuths are not those of texels' borders.
        std::vector<glm::vec3> directions;
        std::vector<double> shares;
        for (int j = 0; j < across; ++j)
            for (int i = 0; i < across; ++i) {
                const double theta = pi * (j + 0.5) / across, phi = 2 * pi * (i + 0.37) / across;
                directions.emplace_back(std::sin(theta) * std::sin(phi), std::cos(theta),
                                        std::sin(theta) * std::cos(phi));
                shares.push_back(std::sin(theta) * 2 * pi * pi / (double(across) * across));
            }
        const Answers answers = ask(e, directions, grid_points(across), compensated);
        const double points = double(answers.drawn.size());
        double total = 0.0;
        glm::dvec3 mean(0.0), drawn(0.0);
        for (std::size_t i = 0; i < directions.size(); ++i) {
            const glm::dvec4& v = answers.lookups[i];
            total += v.w * shares[i];
            mean += glm::dvec3(directions[i]) * v.w * shares[i];
            if (v.x > 0 && !compensated) CHECK(v.w > 0);
        }
        std::vector<glm::vec3> again;
        for (const glm::dvec4& d : answers.drawn) {
            drawn += glm::dvec3(d) / points;
            CHECK(std::abs(glm::length(glm::dvec3(d)) - 1) < 1e-6);
            again.emplace_back(d);
        }
        // Rows and columns of the grid that a border of texels cuts: 1 / across of a texel each.
        const double tolerance = small_sizes() ? 0.25 : 0.02;
        CHECK(std::abs(total - 1) < tolerance);
        for (int k = 0; k < 3; ++k) CHECK(std::abs(mean[k] - drawn[k]) < tolerance);
        const Answers back = ask(e, again, {}, compensated);
        std::size_t same = 0;
        for (std::size_t i = 0; i < again.size(); ++i)
            if (std::abs(back.lookups[i].w - answers.drawn[i].w) <= 1e-4 * answers.drawn[i].w) ++same;
        CHECK(same >= 0.98 * points); // some are drawn on the border of a texel
    }
}

TEST_CASE("environment: drawing by the picture gives the picture's light") {
    const Environment e = random_environment(12, 6);
    // A sequence of low discrepancy: the columns of a grid would fall upon every row's texels alike.
    std::vector<glm::vec2> points;
    for (int i = 0; i < (small_sizes() ? 1024 : 65536); ++i)
        points.emplace_back(glm::fract((i + 0.5) * glm::dvec2(0.7548776662466927, 0.5698402909980532)));
    const Answers answers = ask(e, {}, points);
    const std::vector<glm::dvec4>& drawn = answers.drawn;
    std::vector<glm::vec3> directions;
    for (const glm::dvec4& d : drawn) directions.emplace_back(d);
    const std::vector<glm::dvec4> radiance = ask(e, directions, {}).lookups;
    glm::dvec3 mean(0.0), expected(0.0);
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        const glm::dvec3 light(radiance[i]);
        CHECK(glm::length(answers.light[i] - light) <= 1e-3 * glm::length(light) + 1e-3);
    }
    for (std::size_t i = 0; i < drawn.size(); ++i) mean += glm::dvec3(radiance[i]) / drawn[i].w / double(drawn.size());
    // Bilinear interpolation in double precision, by the midpoint rule.
    const int fine = small_sizes() ? 8 : 32;
    const auto pixel = [&](int x, int y) { return glm::dvec3(e.pixels[std::clamp(y, 0, 5) * 12 + (x + 12) % 12]); };
    for (int j = 0; j < 6 * fine; ++j)
        for (int i = 0; i < 12 * fine; ++i) {
            const double x = (i + 0.5) / fine - 0.5, y = (j + 0.5) / fine - 0.5;
            const int cx = int(std::floor(x)), cy = int(std::floor(y));
            const glm::dvec3 value = glm::mix(glm::mix(pixel(cx, cy), pixel(cx + 1, cy), x - cx),
                                              glm::mix(pixel(cx, cy + 1), pixel(cx + 1, cy + 1), x - cx), y - cy);
            expected += value * std::sin(pi * (j + 0.5) / (6 * fine)) * (pi / (6 * fine)) * (2 * pi / (12 * fine));
        }
    for (int c = 0; c < 3; ++c) CHECK(std::abs(mean[c] / expected[c] - 1) < (small_sizes() ? 0.05 : 5e-3));
}

TEST_CASE("environment: places are drawn by their luminance, between texels too") {
    // A grey picture, so that what is drawn differs by the sine within a row alone, which 64 rows make small.
    Environment e = random_environment(32, 64);
    for (glm::vec3& pixel : e.pixels) pixel = glm::vec3(pixel.x);
    const Answers answers = ask(e, {}, grid_points(small_sizes() ? 16 : 128));
    double sum = 0, squares = 0;
    for (std::size_t i = 0; i < answers.drawn.size(); ++i) {
        const double value = answers.light[i].x / answers.drawn[i].w;
        sum += value;
        squares += value * value;
    }
    const double count = double(answers.drawn.size());
    CHECK(squares * count / (sum * sum) - 1 < 0.01);
}

TEST_CASE("environment: beside surfaces that draw, too, what is drawn is brighter than the mean") {
    Environment e;
    e.width = 64;
    e.height = 32;
    e.pixels.assign(std::size_t{64} * 32, glm::vec3(1.0f));
    e.pixels[64 * 10 + 20] = glm::vec3(2000.0f);
    const glm::dvec3 sun = direction_of(e, 20.5, 10.5);
    std::size_t towards = 0, towards_of_all = 0;
    const std::vector<glm::vec2> points = grid_points(32);
    for (const glm::dvec4& d : ask(e, {}, points, true).drawn) towards += glm::dot(glm::dvec3(d), sun) > std::cos(0.2);
    for (const glm::dvec4& d : ask(e, {}, points).drawn) towards_of_all += glm::dot(glm::dvec3(d), sun) > std::cos(0.2);
    CHECK(towards > 0.99 * double(points.size()));
    CHECK(towards_of_all < 0.6 * double(points.size()));
    const EnvironmentMap map = upload_environment(test_device(), e);
    const EnvironmentRecord record = download(test_device(), map.record)[0];
    CHECK(record.floor == doctest::Approx((2047.0 + 2000.0) / 2048));
    CHECK(record.irradiance_above_floor < 0.6 * record.irradiance);
}

TEST_CASE("environment: a picture of ones has about the density of the sphere, the constant that of the hemisphere") {
    Environment ones;
    ones.width = 32;
    ones.height = 16;
    ones.pixels.assign(512, glm::vec3(1.0f));
    const std::vector<glm::vec2> points = grid_points(16);
    const Answers picture = ask(ones, {{0.6f, 0.8f, 0}, {0.6f, -0.8f, 0}, {0.6f, 0, 0.8f}}, points);
    for (const glm::dvec4& v : picture.lookups) {
        CHECK(v.x == doctest::Approx(1.0));
        CHECK(v.w == doctest::Approx(0.25 / pi).epsilon(0.1));
    }
    Environment constant;
    constant.radiance = {1, 2, 3};
    for (const glm::dvec4& d : ask(constant, {}, points).drawn) {
        CHECK(d.y >= 0.0);
        CHECK(d.w == doctest::Approx(0.5 / pi));
    }
    CHECK(ask(constant, {{0, 1, 0}}, {}).lookups[0].z == 3.0);
}

TEST_CASE("environment: light and density at the poles and beside them") {
    const Environment e = random_environment(16, 8);
    const EnvironmentMap map = upload_environment(test_device(), e);
    const std::vector<float> rows = download(test_device(), map.rows), columns = download(test_device(), map.columns);
    std::vector<glm::vec3> directions;
    for (const float up : {1.0f, -1.0f})
        for (const double off : {1e-3, 1e-6, 1e-9, 1e-15})
            for (int i = 0; i < 32; ++i) {
                const double phi = 2 * pi * (i + 0.3) / 32;
                directions.emplace_back(off * std::sin(phi), up, off * std::cos(phi));
            }
    const Answers answers = ask(e, directions, {});
    for (std::size_t i = 0; i < directions.size(); ++i) {
        const glm::dvec3 d(directions[i]);
        CAPTURE(d.x);
        CAPTURE(d.y);
        // The row of patches beside a pole has one row of texels at both sides, and half the height.
        const std::size_t y = d.y > 0 ? 0 : 7, patch_row = d.y > 0 ? 0 : 8;
        const double x = 8 + 8 * std::atan2(d.z, d.x) / pi, sine = std::hypot(d.x, d.z);
        const auto left = static_cast<std::size_t>(x + 15.5) % 16;
        const glm::dvec3 corners[2] = {glm::dvec3(e.pixels[16 * y + left]),
                                       glm::dvec3(e.pixels[16 * y + (left + 1) % 16])};
        const glm::dvec3 light = glm::mix(corners[0], corners[1], glm::fract(x - 0.5));
        CHECK(glm::distance(glm::dvec3(answers.lookups[i]), light) <= 1e-5 * glm::length(light) + 1e-5);
        const double probability = (rows[patch_row + 1] - rows[patch_row]) *
                                   (columns[17 * patch_row + left + 1] - columns[17 * patch_row + left]);
        const double mean = 0.5 * (luminance(corners[0]) + luminance(corners[1]));
        const double relative = mean > 0 ? luminance(light) / mean : 1;
        CHECK(std::abs(answers.lookups[i].w / (probability * 128 / (pi * pi * sine)) - relative) <= 1e-5);
    }
    // There the density has no end, and no direction is drawn; numbers stay finite, as they do for what is no
    // direction.
    const float infinity = std::numeric_limits<float>::infinity(), nan = std::nanf("");
    const std::vector<glm::vec3> odd = {{0, 1, 0}, {0, -1, 0},      {-0.0f, 1, -0.0f},       {1e-30f, -1, 1e-30f},
                                        {0, 0, 0}, {nan, nan, nan}, {infinity, 0, -infinity}};
    const std::vector<glm::vec2> ends = {{0, 0}, {0.99999994f, 0}, {0, 0.99999994f}, {0.99999994f, 0.99999994f}};
    const Answers finite = ask(e, odd, ends);
    for (std::size_t i = 0; i < odd.size(); ++i) {
        for (int k = 0; k < 3; ++k) CHECK((finite.lookups[i][k] >= 0 && finite.lookups[i][k] < 200));
        CHECK(std::isfinite(finite.lookups[i].w));
        if (i < 4) CHECK(finite.lookups[i].w > 1e12);
    }
    for (std::size_t i = 0; i < ends.size(); ++i) {
        CHECK(glm::length(glm::dvec3(finite.drawn[i])) == doctest::Approx(1.0));
        CHECK((finite.drawn[i].w > 0 && std::isfinite(finite.drawn[i].w)));
        for (int k = 0; k < 3; ++k) CHECK((finite.light[i][k] >= 0 && finite.light[i][k] < 200));
    }
}

TEST_CASE("environment: what is black is none, and sizes must agree") {
    Environment e;
    CHECK(upload_environment(test_device(), e).kind == EnvironmentKind::none);
    e.width = e.height = 2;
    e.pixels.assign(4, glm::vec3(0.0f));
    CHECK(upload_environment(test_device(), e).kind == EnvironmentKind::none);
    e.height = 3;
    CHECK_THROWS_AS(upload_environment(test_device(), e), InputError);
    const Environment sky = default_sky();
    CHECK(sky.pixels.size() == std::size_t{sky.width} * sky.height);
    CHECK(upload_environment(test_device(), sky).kind == EnvironmentKind::picture);
}

TEST_CASE("environment: below the sky is ground that fades into the horizon") {
    const Environment sky = default_sky();
    const std::vector<glm::vec3> below = {{0, -1, 0},
                                          glm::normalize(glm::vec3(0, -0.2f, -1)),
                                          glm::normalize(glm::vec3(0, -0.02f, -1)),
                                          glm::normalize(glm::vec3(0, 0.02f, -1))};
    const std::vector<glm::dvec4> found = ask(sky, below, {}).lookups;
    for (std::size_t i = 0; i + 1 < found.size(); ++i) CHECK(found[i + 1].y > found[i].y);
    CHECK(found[0].x > found[0].z);                      // of soil, not of air
    CHECK(std::abs(found[3].y / found[2].y - 1) < 0.25); // no edge
    // The sun stands in front and to the right.
    const std::vector<glm::dvec4> sun = ask(sky, {glm::normalize(glm::vec3(0.5f, 0.75f, 0.45f))}, {}).lookups;
    CHECK(sun[0].x > 100.0);
}

TEST_CASE("environment: what is no radiance is refused, and its pixel named") {
    const auto refused = [](const Environment& e) {
        try {
            upload_environment(test_device(), e);
        } catch (const InputError& error) {
            return error.where;
        }
        return std::string("accepted");
    };
    const float infinity = std::numeric_limits<float>::infinity();
    for (const float value : {std::nanf(""), -1.0f, -infinity, infinity, std::nextafter(largest_radiance, infinity)}) {
        CAPTURE(value);
        Environment constant;
        constant.radiance.y = value;
        CHECK(refused(constant) == "radiance");
        Environment picture{glm::vec3(0.0f), 3, 2, std::vector<glm::vec3>(6, glm::vec3(largest_radiance))};
        CHECK(refused(picture) == "accepted");
        picture.pixels[4].z = value;
        CHECK(refused(picture) == "pixels[4]");
    }
}
