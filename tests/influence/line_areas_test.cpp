// SPDX-License-Identifier: MIT
// Lines made from a known area, and what they are found to suggest.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "influence/line_areas.hpp"
#include "influence/random_areas.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("influence");

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

glm::dvec3 vector(const float* v) { return {v[0], v[1], v[2]}; }

/// The segment between two points, as a ray over [0, 1].
Ray segment(const glm::dvec3& from, const glm::dvec3& to) {
    const glm::vec3 o(from), d(glm::dvec3(to) - glm::dvec3(o));
    return {{o.x, o.y, o.z}, 0.0f, {d.x, d.y, d.z}, 1.0f};
}

std::vector<Line> lines_of(const std::vector<Ray>& rays) {
    const Hit miss{infinity, 0.0f, 0.0f, BOXWOOD_NONE, BOXWOOD_NONE};
    return lines_of(rays, std::vector<Hit>(rays.size(), miss));
}

DoubleBox cube(double half) {
    DoubleBox box;
    box.add(glm::dvec3(-half));
    box.add(glm::dvec3(half));
    return box;
}

/// 16 x 16 segments from an area's rectangle, or its eye, to `depth` of it, or back.
std::vector<Ray> rays_of(const InfluenceRecord& area, double depth, bool back) {
    const glm::dmat3 world = glm::transpose(exact_frame(area));
    std::vector<Ray> rays;
    for (int i = 0; i < 256; ++i) {
        const double x = area.half_width * ((i % 16 + 0.5) / 8 - 1), y = area.half_height * ((i / 16 + 0.5) / 8 - 1);
        const glm::dvec3 eye = vector(area.origin);
        const double part = depth * (1.0 - 0.5 * (i % 7) / 6); // not all of the same length
        const glm::dvec3 start = area.point != 0 ? eye : eye + world * glm::dvec3(x, y, 0);
        const glm::dvec3 end = eye + world * (area.point != 0 ? part * glm::dvec3(x, y, 1) : glm::dvec3(x, y, part));
        rays.push_back(back ? segment(end, start) : segment(start, end));
    }
    return rays;
}

/// Directions apart from +-y, about which the frame turns by any angle as they turn a little.
glm::dvec3 framed_direction(Random& random) {
    glm::dvec3 d(0, 1, 0);
    while (std::hypot(d.x, d.z) < 0.1) d = random_direction(random);
    return d;
}

/// How far a line of rounded ends may turn, as a share of the sizes here.
constexpr double turn = 0x1p-18;

bool same(const InfluenceArea& a, const InfluenceArea& b) {
    return a.kind == b.kind && a.origin == b.origin && a.direction == b.direction && a.half_width == b.half_width &&
           a.half_height == b.half_height && a.near == b.near && a.far == b.far;
}

/// What the lines of a known area suggest, which is one area of its kind and extents, by all of the lines.
LineArea suggested(const InfluenceArea& known, double depth, bool back, const DoubleBox& scene) {
    const InfluenceRecord record = influence_records({&known, 1})[0];
    const std::vector<LineArea> found = areas_of_lines(lines_of(rays_of(record, depth, back)), scene);
    REQUIRE(found.size() == 1);
    const InfluenceArea& area = found[0].area;
    CHECK(area.kind == known.kind);
    CHECK(found[0].lines.size() == 256);
    // The outermost lines are 15/16 of the half extents from the middle; it reaches a 16th farther, that is 255/256.
    CHECK(area.half_width == doctest::Approx(known.half_width * 255 / 256).epsilon(1e-3));
    CHECK(area.half_height == doctest::Approx(known.half_height * 255 / 256).epsilon(1e-3));
    return found[0];
}

std::vector<Ray> random_segments(Random& random, std::size_t count, double scale) {
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < count; ++i)
        rays.push_back(segment(random_vector(random, scale), random_vector(random, scale)));
    return rays;
}

} // namespace

TEST_CASE("line_areas: lines in one direction suggest the plane area that they come from") {
    Random random(111);
    for (int i = 0; i < 60; ++i) {
        const double scale = std::exp2(i % 3 == 0 ? double(random.below(101)) - 50 : 0);
        InfluenceArea known;
        known.origin = random_vector(random, scale);
        known.direction = framed_direction(random);
        known.half_width = scale * random.uniform(0.2f, 1.5f);
        known.half_height = scale * random.uniform(0.2f, 1.5f);
        known.far = scale;
        const DoubleBox scene = cube(2 * scale);
        INFO("case " << i);
        const LineArea found = suggested(known, scale, i % 2 == 1, scene);
        const InfluenceArea& area = found.area;
        const double sine = glm::length(glm::cross(glm::normalize(area.direction), glm::normalize(known.direction)));
        CHECK(sine < turn * 4);
        const InfluenceRecord record = influence_records({&area, 1})[0];
        for (const Line& line : found.lines) {
            CHECK(contains(record, line.from));
            CHECK(contains(record, line.to));
        }
        // From one end of the scene to the other, and no farther than it takes.
        CHECK(area.far >= 4 * scale);
        CHECK(area.far <= 4 * scale * std::sqrt(3.0) * 1.01);
    }
}

TEST_CASE("line_areas: lines through one point suggest the point area that they come from") {
    Random random(112);
    for (int i = 0; i < 60; ++i) {
        const double scale = std::exp2(i % 3 == 0 ? double(random.below(101)) - 50 : 0);
        InfluenceArea known;
        known.kind = AreaKind::point;
        known.origin = random_vector(random, scale);
        known.direction = framed_direction(random);
        known.half_width = random.uniform(0.1f, 2.0f);
        known.half_height = random.uniform(0.1f, 2.0f);
        known.near = 0.01 * scale;
        known.far = scale;
        const DoubleBox scene = cube(2 * scale);
        INFO("case " << i);
        const LineArea found = suggested(known, scale, i % 2 == 1, scene);
        const InfluenceArea& area = found.area;
        CHECK(glm::length(area.origin - known.origin) < 1e-4 * scale);
        CHECK(glm::length(glm::cross(glm::normalize(area.direction), glm::normalize(known.direction))) < 1e-4);
        const InfluenceRecord record = influence_records({&area, 1})[0];
        for (const Line& line : found.lines) {
            const glm::dvec3 end = i % 2 == 1 ? line.from : line.to;
            CHECK((contains(record, end) || glm::dot(end - area.origin, vector(record.forward)) < area.near));
        }
        double far = 0;
        for (const glm::dvec3& corner : scene.corners())
            far = std::max(far, glm::dot(corner - known.origin, glm::normalize(known.direction)));
        CHECK(area.far == doctest::Approx(far).epsilon(1e-3));
    }
}

TEST_CASE("line_areas: of lines of many kinds the directions that sixteen share suggest areas") {
    Random random(113);
    const DoubleBox scene = cube(2);
    CHECK(areas_of_lines(lines_of(random_segments(random, 256, 2)), scene).empty());

    // Two bundles of parallel lines, one of them both ways, among random lines and some through a point.
    InfluenceArea plane;
    plane.direction = {0, 0, 1};
    InfluenceArea other = plane;
    other.direction = {1, 0, 0.25};
    InfluenceArea point = plane;
    point.kind = AreaKind::point;
    point.near = 0.1;
    const auto some = [](std::vector<Ray> rays, std::size_t from, std::size_t count) {
        return std::vector<Ray>(rays.begin() + static_cast<std::ptrdiff_t>(from),
                                rays.begin() + static_cast<std::ptrdiff_t>(from + count));
    };
    std::vector<Ray> mixed;
    const auto add = [&](const std::vector<Ray>& rays) { mixed.insert(mixed.end(), rays.begin(), rays.end()); };
    add(some(rays_of(influence_records({&other, 1})[0], 1, false), 100, 15));
    add(some(rays_of(influence_records({&plane, 1})[0], 1, false), 0, 100));
    add(random_segments(random, 50, 2));
    add(some(rays_of(influence_records({&plane, 1})[0], 1, true), 200, 40));
    add(some(rays_of(influence_records({&point, 1})[0], 1, false), 0, 60));
    std::vector<LineArea> found = areas_of_lines(lines_of(mixed), scene);
    REQUIRE(found.size() == 1); // fifteen along `other` are too few
    CHECK(found[0].lines.size() >= 140);
    CHECK(found[0].lines.size() <= 145); // and what goes along it by chance
    CHECK(std::abs(glm::normalize(found[0].area.direction).z) == doctest::Approx(1));
    add(some(rays_of(influence_records({&other, 1})[0], 1, false), 0, 1));
    found = areas_of_lines(lines_of(mixed), scene);
    REQUIRE(found.size() == 2);
    CHECK(found[0].area.direction.x > 0.9);
    CHECK(found[0].lines.size() >= 16);
    CHECK(std::abs(found[1].area.direction.z) > 0.99);

    // The same lines suggest the same.
    const std::vector<LineArea> again = areas_of_lines(lines_of(mixed), scene);
    REQUIRE(again.size() == 2);
    for (std::size_t i = 0; i < 2; ++i) CHECK(same(again[i].area, found[i].area));
}

TEST_CASE("line_areas: lines that suggest nothing: too few, from a point to all sides, beyond coordinates") {
    const DoubleBox scene = cube(2);
    InfluenceArea plane;
    const std::vector<Ray> parallel = rays_of(influence_records({&plane, 1})[0], 1, false);
    CHECK(areas_of_lines({}, scene).empty());
    CHECK(areas_of_lines(lines_of({parallel.begin(), parallel.begin() + 15}), scene).empty());
    CHECK(areas_of_lines(lines_of({parallel.begin(), parallel.begin() + 16}), scene).size() == 1);
    // All on one line.
    const std::vector<LineArea> one = areas_of_lines(lines_of(std::vector<Ray>(16, parallel[0])), scene);
    REQUIRE(one.size() == 1);
    CHECK(one[0].area.half_width == doctest::Approx(4 * std::sqrt(3.0) / 1024)); // 2^-10 of the scene's diagonal

    Random random(114);
    std::vector<Ray> around;
    for (int i = 0; i < 256; ++i) around.push_back(segment({0, 0, 0}, glm::normalize(random_vector(random, 1))));
    CHECK(areas_of_lines(lines_of(around), scene).empty());

    // Areas would have to be longer than 2^60, or narrower than 2^-60.
    for (const double scale : {0x1p60, 0x1p-56}) {
        InfluenceArea known;
        known.half_width = known.half_height = known.far = 1;
        std::vector<Ray> rays = rays_of(influence_records({&known, 1})[0], 1, false);
        for (Ray& ray : rays)
            for (int k = 0; k < 3; ++k) {
                ray.origin[k] *= static_cast<float>(scale);
                ray.direction[k] *= static_cast<float>(scale);
            }
        CHECK_NOTHROW(areas_of_lines(lines_of(rays), cube(scale)));
        known.kind = AreaKind::point;
        known.near = 0.5;
        rays = rays_of(influence_records({&known, 1})[0], 1, false);
        for (Ray& ray : rays)
            for (int k = 0; k < 3; ++k) {
                ray.origin[k] *= static_cast<float>(scale);
                ray.direction[k] *= static_cast<float>(scale);
            }
        CHECK_NOTHROW(areas_of_lines(lines_of(rays), cube(scale)));
    }
}

TEST_CASE("line_areas: lines end where rays hit or where their interval does; rays that hit nothing are none") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<Ray> rays{
        {{1, 2, 3}, 0, {0, 0, 2}, infinity}, // hits at 4
        {{1, 2, 3}, 0, {0, 3, 0}, 5},        // ends at 5
        {{1, 2, 3}, 0, {0, 3, 0}, infinity}, // never ends
        {{1, 2, 3}, 0, {0, 0, 0}, 5},        // no direction
        {{nan, 2, 3}, 0, {0, 0, 1}, 5},      // not finite
        {{1, 2, 3}, 0, {0, infinity, 1}, 5}, // nor this
        {{1, 2, 3}, 6, {0, 0, 1}, 5},        // an empty interval
    };
    std::vector<Hit> hits(rays.size(), Hit{infinity, 0, 0, BOXWOOD_NONE, BOXWOOD_NONE});
    hits[0].t = 4;
    const std::vector<Line> lines = lines_of(rays, hits);
    REQUIRE(lines.size() == 2);
    CHECK(lines[0].from == glm::dvec3(1, 2, 3));
    CHECK(lines[0].to == glm::dvec3(1, 2, 11));
    CHECK(lines[0].direction == glm::dvec3(0, 0, 1));
    CHECK(lines[0].ray.direction[2] == 2.0f);
    CHECK(lines[1].to == glm::dvec3(1, 17, 3));
    CHECK(lines[1].direction == glm::dvec3(0, 1, 0));
}

TEST_SUITE_END();
