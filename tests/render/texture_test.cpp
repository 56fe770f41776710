// SPDX-License-Identifier: MIT
// Sampling of textures against the definition in double precision: a plane of texels without end, read through the wrap
// modes.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>

#include <glm/glm.hpp>

#include "runtime/launch.hpp"
#include "shared/material.h"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

namespace {

constexpr double unit = 0x1p-24;
enum Filter { nearest = 0, trilinear = 1, anisotropic = 2 };

struct Query {
    float u, v;
    float x_u, x_v; ///< Footprint: uv along the beam's two axes.
    float y_u, y_v;
};
static_assert(sizeof(Query) == 6 * sizeof(float));

/// A picture and its levels, one behind the other; level l is not made from level 0, so that a mistaken level is seen.
struct Picture {
    TextureRecord record{};
    std::vector<std::uint32_t> texels;

    std::uint32_t across(std::uint32_t level) const { return std::max(record.width >> level, 1u); }
    std::uint32_t down(std::uint32_t level) const { return std::max(record.height >> level, 1u); }
    bool wide() const { return (record.format & BOXWOOD_WIDE) != 0; }
    std::size_t first_word(std::uint32_t level) const {
        std::size_t first = record.first_texel;
        for (std::uint32_t l = 0; l < level; ++l) first += std::size_t{across(l)} * down(l) * (wide() ? 2 : 1);
        return first;
    }
};

Picture random_picture(Random& random, std::uint32_t width, std::uint32_t height, std::uint32_t format = 0) {
    Picture picture;
    picture.record.format = format;
    picture.record.first_texel = 3; // not the first in the array
    picture.record.width = width;
    picture.record.height = height;
    while ((std::max(width, height) >> picture.record.levels) != 0) ++picture.record.levels;
    picture.texels.resize(picture.first_word(picture.record.levels));
    for (std::uint32_t& texel : picture.texels) texel = static_cast<std::uint32_t>(random.bits());
    return picture;
}

std::vector<glm::vec4> sample(const Picture& picture, const std::vector<Query>& queries, Filter filter) {
    Device& device = test_device();
    // Programs of scenes with wide pictures read others as well: here mirrored ones.
    const bool wide = picture.wide() || picture.record.wrap_u == 1;
    std::vector<float> numbers;
    for (const Query& q : queries) numbers.insert(numbers.end(), {q.u, q.v, q.x_u, q.x_v, q.y_u, q.y_v});
    const Buffer<TextureRecord> record = upload(device, std::vector<TextureRecord>{picture.record}, "texture");
    const Buffer<std::uint32_t> texels = upload(device, picture.texels, "texels");
    const Buffer<float> in = upload(device, numbers, "queries");
    Guarded<glm::vec4> out(device, queries.size());
    launch(device,
           {"render/texture_test.cl",
            "sample_test",
            {{"FILTER", std::to_string(filter)}, {"WIDE_TEXELS", wide ? "1" : "0"}}},
           "test", queries.size(), record, texels, in, static_cast<std::uint32_t>(queries.size()), out.view());
    CHECK(out.intact());
    return out.values();
}

double linear(double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); }

/// Index i of a picture n wide that repeats, is mirrored, or ends.
std::int64_t place(std::int64_t i, std::int64_t n, std::uint32_t wrap) {
    if (wrap == 2) return std::clamp<std::int64_t>(i, 0, n - 1);
    const std::int64_t period = wrap == 1 ? 2 * n : n;
    const std::int64_t within = ((i % period) + period) % period;
    return within < n ? within : period - 1 - within;
}

glm::dvec4 texel(const Picture& picture, std::uint32_t level, std::int64_t x, std::int64_t y) {
    const std::int64_t column = place(x, picture.across(level), picture.record.wrap_u);
    const std::int64_t row = place(y, picture.down(level), picture.record.wrap_v);
    const std::int64_t number = row * picture.across(level) + column;
    const std::uint32_t* words = &picture.texels[picture.first_word(level) + number * (picture.wide() ? 2 : 1)];
    glm::dvec4 color;
    for (int c = 0; c < 4; ++c) {
        const double value = picture.wide() ? ((words[c / 2] >> (16 * (c % 2))) & 65535u) / 65535.0
                                            : ((*words >> (8 * c)) & 255u) / 255.0;
        color[c] = c < 3 && (picture.record.format & BOXWOOD_SRGB) ? linear(value) : value;
    }
    return color;
}

glm::dvec4 nearest_at(const Picture& picture, glm::dvec2 uv) {
    return texel(picture, 0, static_cast<std::int64_t>(std::floor(uv.x * picture.record.width)),
                 static_cast<std::int64_t>(std::floor(uv.y * picture.record.height)));
}

glm::dvec4 bilinear_at(const Picture& picture, std::uint32_t level, glm::dvec2 uv) {
    const double x = uv.x * picture.across(level) - 0.5, y = uv.y * picture.down(level) - 0.5;
    const auto left = static_cast<std::int64_t>(std::floor(x)), top = static_cast<std::int64_t>(std::floor(y));
    const double a = x - std::floor(x), b = y - std::floor(y);
    return (1.0 - b) * ((1.0 - a) * texel(picture, level, left, top) + a * texel(picture, level, left + 1, top)) +
           b * ((1.0 - a) * texel(picture, level, left, top + 1) + a * texel(picture, level, left + 1, top + 1));
}

glm::dvec4 trilinear_at(const Picture& picture, glm::dvec2 uv, double width) {
    const double last = picture.record.levels - 1;
    const double detail = width > 1.0 ? std::min(std::log2(width), last) : 0.0;
    const auto level = static_cast<std::uint32_t>(detail);
    const double fraction = detail - level;
    const glm::dvec4 fine = bilinear_at(picture, level, uv);
    return fraction == 0.0 ? fine : (1.0 - fraction) * fine + fraction * bilinear_at(picture, level + 1, uv);
}

/// The ellipse of a footprint in texels: a 2 x 2 matrix as two complex numbers, one turning with and one against.
struct Ellipse {
    double longer, shorter;
    glm::dvec2 axis; ///< Of the longer one, normalised.
};

Ellipse ellipse_of(const Picture& picture, const Query& q) {
    const double w = picture.record.width, h = picture.record.height;
    const double ax = q.x_u * w, ay = q.x_v * h, bx = q.y_u * w, by = q.y_v * h;
    const std::complex<double> with(ax + by, ay - bx), against(ax - by, ay + bx);
    const double angle = 0.5 * (std::arg(with) + std::arg(against));
    return {0.5 * (std::abs(with) + std::abs(against)),
            0.5 * std::abs(std::abs(with) - std::abs(against)),
            {std::cos(angle), std::sin(angle)}};
}

glm::dvec4 anisotropic_at(const Picture& picture, const Query& q, double taps_factor) {
    const Ellipse e = ellipse_of(picture, q);
    const double width = std::max({e.shorter, 1.0, e.longer / 16.0});
    const int taps = std::clamp(static_cast<int>(std::ceil(taps_factor * e.longer / width)), 1, 16);
    glm::dvec4 sum(0.0);
    for (int i = 0; i < taps; ++i) {
        const double along = e.longer * ((i + 0.5) / taps - 0.5);
        const glm::dvec2 step(along * e.axis.x / picture.record.width, along * e.axis.y / picture.record.height);
        sum += trilinear_at(picture, glm::dvec2(q.u, q.v) + step, width);
    }
    return sum / static_cast<double>(taps);
}

double difference(const glm::vec4& a, const glm::dvec4& b) {
    const glm::dvec4 d = glm::abs(glm::dvec4(a) - b);
    const double most = std::max({d.x, d.y, d.z, d.w});
    return most >= 0.0 ? most : std::numeric_limits<double>::infinity(); // NaN
}

/// What float may be off by: a texel is at most 1 from the next, so an error of the place, in texels, is one of the
/// colour.
double tolerance(const Picture& picture, const Query& q) {
    const double size = std::max(picture.record.width, picture.record.height);
    const double reach = std::max({std::fabs(q.u), std::fabs(q.v), 1.0f}) + std::fabs(q.x_u) + std::fabs(q.x_v) +
                         std::fabs(q.y_u) + std::fabs(q.y_v);
    return unit * (8.0 * size * reach + 64.0);
}

constexpr std::array<std::array<std::uint32_t, 2>, 6> sizes = {
    {{1, 1}, {2, 1}, {1, 7}, {5, 3}, {64, 64}, {37, 100}}}; // alone, a row, a column, odd, a power of two, mixed

std::vector<Query> random_queries(Random& random, const Picture& picture, std::size_t count) {
    std::vector<Query> queries;
    for (std::size_t i = 0; i < count; ++i) {
        // From a hundredth of a texel to the whole picture and beyond, of any shape.
        const auto length = [&] { return std::exp2(random.uniform(-7, 9)); };
        const auto turn = [&] { return random.uniform(-1, 1); };
        const float w = static_cast<float>(picture.record.width), h = static_cast<float>(picture.record.height);
        const float a = length(), b = length();
        queries.push_back({random.uniform(-3, 3), random.uniform(-3, 3), a * turn() / w, a * turn() / h, b * turn() / w,
                           b * turn() / h});
    }
    return queries;
}

/// Calls check(picture) for every size, wrap mode (crossed), encoding and magnification.
template <class Check>
void for_pictures(const Check& check) {
    Random random(301);
    for (const auto& size : sizes)
        for (std::uint32_t mode = 0; mode < 6; ++mode) {
            const std::uint32_t format = (mode & 1 ? BOXWOOD_SRGB : 0u) | (mode < 3 ? 0u : BOXWOOD_WIDE);
            Picture picture = random_picture(random, size[0], size[1], format);
            picture.record.wrap_u = mode % 3;
            picture.record.wrap_v = (mode + 1) % 3;
            picture.record.nearest = size[0] == 5;
            CAPTURE(size[0]);
            CAPTURE(size[1]);
            CAPTURE(mode);
            check(picture, random);
        }
}

std::size_t small(std::size_t count) { return small_sizes() ? 16 : count; }

bool magnified_block(const Picture& picture, const Query& q) {
    return picture.record.nearest && ellipse_of(picture, q).longer <= 1.0;
}

} // namespace

TEST_CASE("texture: bytes of sRGB are decoded to a unit in the last place") {
    Picture picture;
    picture.record = {0, 256, 1, 1, 0, 0, 0, BOXWOOD_SRGB};
    std::vector<Query> queries;
    for (std::uint32_t i = 0; i < 256; ++i) {
        picture.texels.push_back(i * 0x01010101u);
        queries.push_back({(static_cast<float>(i) + 0.5f) / 256.0f, 0.5f, 0, 0, 0, 0});
    }
    const std::vector<glm::vec4> colors = sample(picture, queries, nearest);
    for (std::uint32_t i = 0; i < 256; ++i) {
        for (int c = 0; c < 3; ++c) CHECK(std::fabs(colors[i][c] - linear(i / 255.0)) <= 1e-7 * linear(i / 255.0));
        CHECK(std::fabs(colors[i].w - i / 255.0) <= 3e-7 * i / 255.0);
    }
}

TEST_CASE("texture: each of the 65536 values of 16 bits is decoded, and brighter than the one before") {
    Picture picture;
    picture.record = {0, 256, 256, 1, 0, 0, 0, BOXWOOD_SRGB | BOXWOOD_WIDE};
    std::vector<Query> queries;
    for (std::uint32_t i = 0; i < 65536; ++i) {
        picture.texels.insert(picture.texels.end(), {i * 0x00010001u, i * 0x00010001u});
        queries.push_back(
            {(static_cast<float>(i % 256) + 0.5f) / 256.0f, (static_cast<float>(i / 256) + 0.5f) / 256.0f, 0, 0, 0, 0});
    }
    const std::vector<glm::vec4> colors = sample(picture, queries, nearest);
    for (std::uint32_t i = 0; i < 65536; ++i) {
        const double wanted = linear(i / 65535.0);
        REQUIRE(std::fabs(colors[i].x - wanted) <= 0x1p-22 * wanted);
        REQUIRE(colors[i].y == colors[i].x);
        REQUIRE(colors[i].z == colors[i].x);
        REQUIRE(std::fabs(colors[i].w - i / 65535.0) <= 3e-7 * i / 65535.0);
        if (i > 0) REQUIRE(colors[i].x > colors[i - 1].x);
    }
}

TEST_CASE("texture: every filter is its definition in double precision") {
    std::size_t checked = 0;
    for_pictures([&](const Picture& picture, Random& random) {
        const std::vector<Query> queries = random_queries(random, picture, small(2000));
        const std::vector<glm::vec4> one = sample(picture, queries, trilinear);
        const std::vector<glm::vec4> many = sample(picture, queries, anisotropic);
        const std::vector<glm::vec4> block = sample(picture, queries, nearest);
        for (std::size_t i = 0; i < queries.size(); ++i) {
            const Query& q = queries[i];
            const double bound = tolerance(picture, q), shift = bound / picture.record.width;
            // A place that is a rounding from the next texel may be in either.
            double off = std::numeric_limits<double>::infinity();
            for (const double x : {-shift, shift})
                for (const double y : {-shift, shift})
                    off = std::min(off, difference(block[i], nearest_at(picture, {q.u + x, q.v + y})));
            REQUIRE(off <= bound);
            if (std::fabs(ellipse_of(picture, q).longer - 1.0) < 1e-5) continue; // `nearest` may be on or off
            ++checked;
            if (magnified_block(picture, q)) {
                REQUIRE(one[i] == block[i]);
                REQUIRE(many[i] == block[i]);
                continue;
            }
            REQUIRE(difference(one[i], trilinear_at(picture, {q.u, q.v}, ellipse_of(picture, q).longer)) <= bound);
            // Likewise a ratio of the axes that is a rounding from an integer.
            REQUIRE(std::min(difference(many[i], anisotropic_at(picture, q, 1.0 - 1e-5)),
                             difference(many[i], anisotropic_at(picture, q, 1.0 + 1e-5))) <= bound);
        }
    });
    CHECK(checked > 0);
}

TEST_CASE("texture: no footprint reads level 0, and texel centres give the texel") {
    for_pictures([&](const Picture& picture, Random&) {
        std::vector<Query> queries;
        std::vector<glm::dvec4> expected;
        for (std::uint32_t y = 0; y < picture.record.height; ++y)
            for (std::uint32_t x = 0; x < picture.record.width; ++x) {
                queries.push_back({(static_cast<float>(x) + 0.5f) / static_cast<float>(picture.record.width),
                                   (static_cast<float>(y) + 0.5f) / static_cast<float>(picture.record.height), 0, 0, 0,
                                   0});
                expected.push_back(texel(picture, 0, x, y));
            }
        for (const Filter filter : {nearest, trilinear, anisotropic}) {
            const std::vector<glm::vec4> colors = sample(picture, queries, filter);
            for (std::size_t i = 0; i < queries.size(); ++i)
                REQUIRE(difference(colors[i], expected[i]) <= tolerance(picture, queries[i]));
        }
    });
}

TEST_CASE("texture: any coordinate and footprint reads a texel") {
    // Guarded against reads outside by the checker of memory; here against NaN and colours that no texel has.
    constexpr float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<float> numbers = {0.0f,  -0.0f, 1.0f,   -1.0f,    -1e-30f,   1e-45f, -1e-45f,    0x1p24f,   1e9f,
                                        -1e9f, 3e38f, -3e38f, infinity, -infinity, nan,    0.9999999f, -0x1p-25f, 2.0f};
    std::vector<Query> queries;
    Random random(302);
    for (const float u : numbers)
        for (const float v : numbers) {
            const auto any = [&] { return numbers[random.below(static_cast<std::uint32_t>(numbers.size()))]; };
            queries.push_back({u, v, 0, 0, 0, 0});
            queries.push_back({u, v, any(), any(), any(), any()});
            queries.push_back({0.3f, 0.6f, u, v, any(), any()});
        }
    for_pictures([&](const Picture& picture, Random&) {
        for (const Filter filter : {nearest, trilinear, anisotropic})
            for (const glm::vec4& color : sample(picture, queries, filter))
                for (int c = 0; c < 4; ++c) REQUIRE((color[c] >= 0.0f && color[c] <= 1.0f));
    });
}

TEST_CASE("texture: turning a beam about itself changes nothing") {
    // A circle is the same however it is cut into two axes; so is the ellipse it becomes on a surface.
    Random random(303);
    const Picture picture = random_picture(random, 64, 64);
    std::vector<Query> straight, turned;
    for (std::size_t i = 0; i < small(500); ++i) {
        const Query q = random_queries(random, picture, 1)[0];
        const float angle = random.uniform(0, 6), c = std::cos(angle), s = std::sin(angle);
        straight.push_back(q);
        turned.push_back(
            {q.u, q.v, c * q.x_u + s * q.y_u, c * q.x_v + s * q.y_v, c * q.y_u - s * q.x_u, c * q.y_v - s * q.x_v});
    }
    for (const Filter filter : {trilinear, anisotropic}) {
        const std::vector<glm::vec4> a = sample(picture, straight, filter), b = sample(picture, turned, filter);
        std::size_t different = 0;
        for (std::size_t i = 0; i < a.size(); ++i)
            if (difference(a[i], glm::dvec4(b[i])) > 64.0 * tolerance(picture, straight[i])) ++different;
        // One tap more or less where the ratio of the axes is a rounding from an integer.
        CHECK(different <= a.size() / 100);
    }
}

TEST_CASE("texture: the anisotropic filter keeps what lies across the shorter axis") {
    // Columns black and white, of a picture so filtered that a level is the mean of the one before: grey from level 1
    // on. A footprint of one texel across the columns and 16 along them sees a column, and the trilinear filter grey.
    Picture picture;
    picture.record = {0, 32, 32, 6, 0, 0, 0, 0};
    picture.texels.resize(picture.first_word(6), 0x80808080u);
    for (std::uint32_t i = 0; i < 32 * 32; ++i) picture.texels[i] = i % 2 ? 0xffffffffu : 0u;
    const std::vector<Query> queries = {{4.5f / 32, 0.3f, 1.0f / 32, 0, 0, 0.5f},
                                        {5.5f / 32, 0.3f, 0, 0.5f, 1.0f / 32, 0}};
    const std::vector<glm::vec4> many = sample(picture, queries, anisotropic),
                                 one = sample(picture, queries, trilinear);
    CHECK(std::fabs(many[0].x) < 1e-4);
    CHECK(std::fabs(many[1].x - 1.0) < 1e-4);
    for (const glm::vec4& color : one) CHECK(std::fabs(color.x - 128.0 / 255.0) < 1e-6);
}

TEST_SUITE_END();
