// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "boxwood/influence.hpp"
#include "build/area_triangles.hpp"
#include "influence/random_areas.hpp"
#include "runtime/launch.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("build");

namespace {

using Triangle3 = std::array<glm::vec3, 3>;

glm::dvec3 vector(const float* v) { return {v[0], v[1], v[2]}; }

std::vector<std::uint32_t> listed(const std::vector<Triangle3>& triangles, const InfluenceRecord& area) {
    std::vector<float> positions;
    std::vector<std::uint32_t> indices;
    for (const Triangle3& triangle : triangles)
        for (const glm::vec3& corner : triangle) {
            indices.push_back(static_cast<std::uint32_t>(indices.size()));
            positions.insert(positions.end(), {corner.x, corner.y, corner.z});
        }
    Device& device = test_device();
    return download(device, area_triangles(device, upload(device, positions, "positions"),
                                           upload(device, indices, "triangles"), area));
}

/// Whether the triangle reaches into the region, each of whose sides is moved outwards by `margin` times the sum of its
/// normal's magnitudes in the area's coordinates.
bool reaches(const Triangle3& triangle, const InfluenceRecord& area, double margin) {
    const double w = area.half_width, h = area.half_height;
    std::vector<glm::dvec3> polygon;
    for (const glm::vec3& corner : triangle) {
        const glm::dvec3 d = glm::dvec3(corner) - vector(area.origin);
        polygon.emplace_back(glm::dot(d, vector(area.right)), glm::dot(d, vector(area.up)),
                             glm::dot(d, vector(area.forward)));
    }
    const auto cut_by = [&](const glm::dvec3& normal, double least) {
        const double bound = least - margin * (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z));
        std::vector<glm::dvec3> kept;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const glm::dvec3 p = polygon[i], q = polygon[(i + 1) % polygon.size()];
            const double a = glm::dot(normal, p) - bound, b = glm::dot(normal, q) - bound;
            if (a >= 0) kept.push_back(p);
            if ((a >= 0) != (b >= 0)) kept.push_back(p + (q - p) * (a / (a - b)));
        }
        polygon = kept;
    };
    cut_by({0, 0, 1}, area.near);
    cut_by({0, 0, -1}, -double(area.far));
    for (const double side : {-1.0, 1.0}) {
        cut_by({side, 0, area.point != 0 ? w : 0}, area.point != 0 ? 0 : -w);
        cut_by({0, side, area.point != 0 ? h : 0}, area.point != 0 ? 0 : -h);
    }
    return !polygon.empty();
}

/// The margin of area_triangles.cl, for the triangle.
double margin_of(const Triangle3& triangle, const InfluenceRecord& area) {
    double size = 0;
    for (const glm::vec3& corner : triangle) {
        const glm::dvec3 d = glm::abs(glm::dvec3(corner) - vector(area.origin));
        size = std::max(size, d.x + d.y + d.z);
    }
    const double sides = double(area.half_width) + area.half_height;
    const double spread = area.point != 0 ? 1 + std::max(area.half_width, area.half_height) : 1;
    return 0x1p-16 * (size + area.far + (area.point != 0 ? area.far * sides : sides)) * spread * spread;
}

/// Triangles of all sizes in and about a region: also slivers, lines and points, large ones that cross it with no
/// corner or edge inside, and some that touch its sides, edges or corners from outside.
std::vector<Triangle3> random_triangles(Random& random, const InfluenceRecord& area, double scale, int count) {
    const std::array<glm::dvec3, 8> points = corners(area);
    glm::dvec3 middle(0);
    for (const glm::dvec3& p : points) middle += p / 8.0;
    std::vector<Triangle3> triangles;
    for (int i = 0; i < count; ++i) {
        const double size = scale * std::exp2(double(random.uniform(-8, 6)));
        const glm::dvec3 place = random_place(random, area, scale);
        glm::dvec3 corner[3];
        for (glm::dvec3& c : corner) c = place + random_vector(random, size);
        const std::uint32_t kind = random.below(8);
        if (kind == 0) corner[2] = corner[0] + (corner[1] - corner[0]) * double(random.uniform(-1, 2)); // nearly a line
        if (kind == 1) corner[2] = corner[0];
        if (kind == 2) corner[1] = corner[2] = corner[0];
        if (kind == 3) { // about a point of the region, from far away
            const glm::dvec3 normal = random_vector(random, 1), u = glm::cross(normal, random_vector(random, 1)),
                             v = glm::cross(normal, u);
            for (int k = 0; k < 3; ++k)
                corner[k] = place + 100 * scale * (u * std::cos(2.1 * k) + v * std::sin(2.1 * k));
        }
        if (kind == 4) { // a corner of the region and others farther from its middle
            const glm::dvec3 touched = points[random.below(8)] * 0.5 + points[random.below(8)] * 0.5;
            corner[0] = touched;
            for (int k = 1; k < 3; ++k)
                corner[k] =
                    touched + (touched - middle) * double(random.uniform(0, 1)) + random_vector(random, 0.3 * size);
        }
        Triangle3 triangle;
        for (int k = 0; k < 3; ++k) triangle[k] = corner[k];
        triangles.push_back(triangle);
    }
    return triangles;
}

} // namespace

TEST_CASE("area_triangles: the triangles of an area are those that reach into its region, and none far outside") {
    Random random(97);
    std::size_t in = 0, out = 0, between = 0;
    for (int a = 0; a < (small_sizes() ? 4 : 100); ++a) {
        const double scale = std::exp2(a % 4 == 0 ? double(random.below(110)) - 55 : 0);
        InfluenceRecord area = random_area(random, a % 2 == 1, scale);
        if (a % 4 == 3) area.near = 0; // from the eye on, as local trees have it
        const std::vector<Triangle3> triangles = random_triangles(random, area, scale, small_sizes() ? 20 : 500);
        const std::vector<std::uint32_t> found = listed(triangles, area);
        CHECK(std::is_sorted(found.begin(), found.end()));
        const std::set<std::uint32_t> set(found.begin(), found.end());
        CHECK(set.size() == found.size());
        for (std::uint32_t i = 0; i < triangles.size(); ++i) {
            INFO("area " << a << ", triangle " << i);
            const double margin = margin_of(triangles[i], area);
            const bool inside = reaches(triangles[i], area, 0), close = reaches(triangles[i], area, 2 * margin);
            if (inside) CHECK(set.count(i) == 1);
            if (!close) CHECK(set.count(i) == 0);
            (inside ? in : close ? between : out)++;
        }
    }
    if (!small_sizes()) {
        CHECK(in > 10000);
        CHECK(out > 10000);
        CHECK(between > 1000); // those that touch
    }
}

TEST_CASE("area_triangles: triangles that touch a region are listed, whatever touches what") {
    const InfluenceRecord plane = make_area(false, {0, 0, 0}, {0, 0, -1}, 1, 1, 0, 2);
    const InfluenceRecord point = make_area(true, {0, 0, 0}, {0, 0, -1}, 1, 1, 1, 2);
    const std::vector<Triangle3> touching{
        {{{1, 0, -1.5f}, {3, 1, -1}, {3, -1, -1}}},   // corner to face of the box; edge of the frustum's inside
        {{{1, 1, -1}, {3, 1, -1}, {1, 3, -1}}},       // corner to edge, and to a corner of the frustum
        {{{3, -1, -1}, {-1, 3, -1}, {3, 3, -1}}},     // edge to edge, and to a corner
        {{{-9, -9, -2}, {9, -9, -2}, {0, 9, -2}}},    // face to face
        {{{-1, -1, -2}, {-1, -1, -2}, {-1, -1, -2}}}, // a point on a corner
        {{{-100, -100, -1.5f}, {100, -100, -1.5f}, {0, 200, -1.5f}}}, // no corner, no edge inside
    };
    const std::vector<std::uint32_t> all{0, 1, 2, 3, 4, 5};
    CHECK(listed(touching, plane) == all);
    CHECK(listed(touching, point) == all);
    std::vector<Triangle3> beside{{{{1.01f, 0, -1}, {3, 1, -1}, {3, -1, -1}}},
                                  {{{1.01f, 1.01f, -1}, {3, 1, -1}, {1, 3, -1}}},
                                  {{{3, -0.98f, -1}, {-0.98f, 3, -1}, {3, 3, -1}}},
                                  {{{-9, -9, -2.01f}, {9, -9, -2.01f}, {0, 9, -2.01f}}},
                                  {{{-9, -9, 0.01f}, {9, -9, 0.01f}, {0, 9, 0.01f}}}};
    CHECK(listed(beside, plane).empty());
    for (Triangle3& triangle : beside)
        for (glm::vec3& corner : triangle)
            if (corner.z == 0.01f) corner.z = -0.99f;
    CHECK(listed(beside, point).empty());
    CHECK(listed({}, plane).empty());
}

TEST_CASE("area_triangles: rays inside a region hit no triangle that its list lacks") {
    Random random(98);
    Device& device = test_device();
    std::size_t hits = 0;
    for (int a = 0; a < (small_sizes() ? 2 : 40); ++a) {
        const InfluenceRecord area = random_area(random, a % 2 == 1, 1);
        const std::vector<Triangle3> triangles = random_triangles(random, area, 1, small_sizes() ? 10 : 200);
        const std::vector<std::uint32_t> found = listed(triangles, area);
        const std::set<std::uint32_t> set(found.begin(), found.end());
        // From the rectangle, from its sides and from inside, along the area, back, and anywhere.
        std::vector<float> origins, directions;
        const std::uint32_t count = small_sizes() ? 20 : 500;
        for (std::uint32_t i = 0; i < count; ++i) {
            glm::dvec3 share(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0, 1));
            if (i % 3 == 0) share.z = 0;
            if (i % 5 == 0) share[static_cast<int>(random.below(2))] = random.below(2) == 0 ? 1 : -1;
            const double depth = area.near + share.z * (double(area.far) - area.near),
                         unit = area.point != 0 ? depth : 1;
            const glm::dvec3 local(share.x * unit * area.half_width, share.y * unit * area.half_height, depth);
            const glm::dmat3 world = glm::transpose(exact_frame(area));
            const glm::dvec3 origin = vector(area.origin) + world * local;
            glm::dvec3 direction =
                i % 4 == 0 ? random_vector(random, 1) : world * (area.point != 0 ? local : glm::dvec3(0, 0, 1));
            if (i % 4 == 1) direction = -direction;
            for (int k = 0; k < 3; ++k) origins.push_back(static_cast<float>(origin[k]));
            for (int k = 0; k < 3; ++k) directions.push_back(static_cast<float>(direction[k]));
        }
        const Guarded<float> exits(device, count);
        const Guarded<std::uint32_t> flags(device, count);
        launch(device, {"influence/influence_test.cl", "influence_test"}, "influence test", count,
               upload(device, std::vector<InfluenceRecord>(count, area), "areas"), upload(device, origins, "origins"),
               upload(device, directions, "directions"), exits.view(), flags.view(), count);
        const std::vector<float> exit = exits.values();
        const std::vector<std::uint32_t> contained = flags.values();
        for (std::uint32_t i = 0; i < count; ++i) {
            if ((contained[i] & 1) == 0) continue;
            const glm::dvec3 o = vector(&origins[3 * i]), d = vector(&directions[3 * i]);
            for (std::uint32_t t = 0; t < triangles.size(); ++t) {
                const glm::dvec3 v0 = triangles[t][0], e1 = glm::dvec3(triangles[t][1]) - v0,
                                 e2 = glm::dvec3(triangles[t][2]) - v0;
                const glm::dvec3 p = glm::cross(d, e2), q = glm::cross(o - v0, e1);
                const double det = glm::dot(e1, p), u = glm::dot(o - v0, p) / det, v = glm::dot(d, q) / det,
                             time = glm::dot(e2, q) / det;
                if (!(det != 0 && u >= 0 && v >= 0 && u + v <= 1 && time >= 0 && time <= exit[i])) continue;
                ++hits;
                INFO("area " << a << ", ray " << i << ", triangle " << t);
                CHECK(set.count(t) == 1);
            }
        }
    }
    if (!small_sizes()) CHECK(hits > 10000);
}

TEST_SUITE_END();
