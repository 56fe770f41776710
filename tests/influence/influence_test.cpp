// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "boxwood/error.hpp"
#include "boxwood/influence.hpp"
#include "influence/random_areas.hpp"
#include "oracles/projection.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("influence");

namespace {

glm::dvec3 vector(const float* v) { return {v[0], v[1], v[2]}; }

glm::dvec3 corner_of(const Aabb& box, int i) {
    return {(i & 1 ? box.max : box.min)[0], (i & 2 ? box.max : box.min)[1], (i & 4 ? box.max : box.min)[2]};
}

/// The planes of a region, as normal (inwards) and the least dot product with what is seen from the origin.
std::vector<std::pair<glm::dvec3, double>> planes_of(const InfluenceRecord& area) {
    const glm::dvec3 right = vector(area.right), up = vector(area.up), forward = vector(area.forward);
    const double w = area.half_width, h = area.half_height;
    if (area.point == 0) return {{forward, 0}, {-forward, -area.far}, {right, -w}, {-right, -w}, {up, -h}, {-up, -h}};
    return {{forward, area.near},     {-forward, -area.far}, {w * forward + right, 0},
            {w * forward - right, 0}, {h * forward + up, 0}, {h * forward - up, 0}};
}

/// Whether a part of the box is inside the region, moved outwards by `margin`: its faces are cut by the planes. A
/// region inside the box shows by its corners.
bool meets(const InfluenceRecord& area, const Aabb& box, double margin) {
    for (const glm::dvec3& corner : corners(area)) {
        bool inside = true;
        for (int k = 0; k < 3; ++k)
            inside = inside && corner[k] >= box.min[k] - margin && corner[k] <= box.max[k] + margin;
        if (inside) return true;
    }
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side) {
            const int b = 1 << (axis + 1) % 3, c = 1 << (axis + 2) % 3, first = side << axis;
            std::vector<glm::dvec3> face{corner_of(box, first), corner_of(box, first + b),
                                         corner_of(box, first + b + c), corner_of(box, first + c)};
            for (const auto& [normal, least] : planes_of(area)) {
                std::vector<glm::dvec3> kept;
                for (std::size_t i = 0; i < face.size(); ++i) {
                    const glm::dvec3 p = face[i], q = face[(i + 1) % face.size()];
                    const double bound = least - margin * glm::length(normal);
                    const double at_p = glm::dot(normal, p - vector(area.origin)) - bound,
                                 at_q = glm::dot(normal, q - vector(area.origin)) - bound;
                    if (at_p >= 0) kept.push_back(p);
                    if ((at_p >= 0) != (at_q >= 0)) kept.push_back(p + (q - p) * (at_p / (at_p - at_q)));
                }
                face = kept;
            }
            if (!face.empty()) return true;
        }
    return false;
}

} // namespace

TEST_CASE("influence: records of influence areas: frames, shares and what is refused") {
    Random random(91);
    std::vector<InfluenceArea> areas(200);
    for (std::size_t i = 0; i < areas.size(); ++i) {
        areas[i].direction = random_direction(random) * std::exp2(double(random.below(2000)) - 1000);
        if (i < 2) areas[i].direction = {0, i == 0 ? 1e-300 : -1e300, 0};
        if (i % 2 == 1) areas[i].kind = AreaKind::point;
        if (i % 2 == 1) areas[i].near = 0.25;
        areas[i].tolerance_degrees = 0.01 * double(i);
    }
    const std::vector<InfluenceRecord> records = influence_records(areas);
    for (std::size_t i = 0; i < areas.size(); ++i) {
        const InfluenceRecord& r = records[i];
        const glm::dvec3 right = vector(r.right), up = vector(r.up), forward = vector(r.forward);
        const glm::dvec3 d =
            areas[i].direction /
            std::max({std::abs(areas[i].direction.x), std::abs(areas[i].direction.y), std::abs(areas[i].direction.z)});
        CHECK(glm::length(forward - glm::normalize(d)) <= 0x1p-23);
        CHECK(glm::length(glm::cross(right, forward) - up) <= 0x1p-22);
        CHECK(std::abs(glm::length(right) - 1) <= 0x1p-23);
        CHECK((i < 2 ? up.z == 1 : up.y >= 0));
        CHECK(std::abs(right.y) <= 0x1p-23);
        CHECK(r.point == i % 2);
        CHECK(r.share == doctest::Approx(1.0 / 201));
        CHECK(r.sin_tolerance == doctest::Approx(std::sin(glm::radians(0.01 * double(i)))));
    }

    std::vector<InfluenceArea> three(3);
    three[1].share = 0.4;
    const std::vector<InfluenceRecord> shared = influence_records(three);
    CHECK(shared[0].share == doctest::Approx(0.2));
    CHECK(shared[1].share == doctest::Approx(0.4));
    CHECK(shared[2].share == doctest::Approx(0.2));
    for (InfluenceArea& area : three) area.share = 1.0 / 3;
    CHECK(influence_records(three)[2].share == doctest::Approx(1.0 / 3));
    std::vector<InfluenceArea> tenths(10); // ten times 0.1 is above 1 in some orders
    for (InfluenceArea& area : tenths) area.share = 0.1;
    CHECK(influence_records(tenths).size() == 10);
    three[2].share = 0.34;
    CHECK_THROWS_WITH_AS(influence_records(three), doctest::Contains("area 2"), InputError);
    CHECK(influence_records({}).empty());

    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    for (const double bad : {nan, infinity, -infinity}) {
        for (double InfluenceArea::*member :
             {&InfluenceArea::half_width, &InfluenceArea::half_height, &InfluenceArea::near, &InfluenceArea::far,
              &InfluenceArea::tolerance_degrees})
            for (const AreaKind kind : {AreaKind::plane, AreaKind::point}) {
                InfluenceArea area;
                area.kind = kind;
                area.near = kind == AreaKind::point ? 0.5 : 0;
                CHECK(influence_records({&area, 1}).size() == 1);
                area.*member = bad;
                CHECK_THROWS_AS(influence_records({&area, 1}), InputError);
            }
        InfluenceArea area;
        area.share = bad;
        CHECK_THROWS_AS(influence_records({&area, 1}), InputError);
        area = {};
        area.direction.y = bad;
        CHECK_THROWS_AS(influence_records({&area, 1}), InputError);
        area = {};
        area.origin.z = bad;
        CHECK_THROWS_AS(influence_records({&area, 1}), InputError);
    }
    CHECK_THROWS_AS(influence_records(std::vector<InfluenceArea>(most_areas + 1)), CapacityError);
}

TEST_CASE("influence: regions and boxes: contained, enclosed, met") {
    Random random(92);
    int met = 0, missed = 0, enclosed = 0, unclear = 0;
    for (int i = 0; i < (small_sizes() ? 200 : 20000); ++i) {
        const double scale = std::exp2(i % 8 == 0 ? double(random.below(117)) - 58 : 0);
        InfluenceRecord area = random_area(random, i % 2 == 1, scale);
        area.far *= random.uniform(0.15f, 0.5f);
        if (i % 4 == 3) area.near = 0; // from the eye on, as local trees have it
        glm::dvec3 place = random_place(random, area, scale);
        if (i % 8 == 7) { // beside an edge of the far face, where only a cross of edges tells
            const std::array<glm::dvec3, 8> points = corners(area);
            place = 0.5 * (points[4 + random.below(2)] + points[6 + random.below(2)]) + random_vector(random, scale);
        }
        const Aabb box = random_box(random, (i % 7 == 0 ? 4 : 1) * scale, place);
        INFO("case " << i);
        // Closer than that, either is right.
        const double margin = 1e-12 * 40 * scale;
        const bool inner = meets(area, box, -margin), outer = meets(area, box, margin), found = intersects(area, box);
        if (inner) CHECK(found);
        if (!outer) CHECK(!found);
        unclear += inner != outer;
        (found ? met : missed)++;

        const std::array<glm::dvec3, 8> points = corners(area);
        glm::dvec3 least(INFINITY), most(-INFINITY);
        for (const glm::dvec3& p : points) {
            least = glm::min(least, p);
            most = glm::max(most, p);
        }
        const Aabb around = enclosing_box(area);
        for (int k = 0; k < 3; ++k) {
            CHECK(around.min[k] < least[k]);
            CHECK(around.max[k] > most[k]);
            CHECK(around.max[k] - around.min[k] <=
                  (most[k] - least[k]) + 0x1p-22 * (std::abs(least[k]) + std::abs(most[k])));
        }
        // Points between the corners are inside; those a little beyond the corners are not.
        glm::dvec3 middle(0);
        for (const glm::dvec3& p : points) middle += p / 8.0;
        CHECK(contains(area, middle));
        for (const glm::dvec3& p : points) {
            CHECK(contains(area, p + (middle - p) * 1e-9));
            CHECK(!contains(area, p - (middle - p) * 1e-9));
        }
        bool all = true;
        for (int c = 0; c < 8; ++c) {
            bool inside = true;
            for (const auto& [normal, bound] : planes_of(area))
                inside = inside && glm::dot(normal, corner_of(box, c) - vector(area.origin)) >= bound;
            all = all && inside;
        }
        CHECK(encloses(area, box) == all);
        enclosed += all;
        if (all) CHECK(found);
    }
    CHECK(unclear <= 2);
    if (!small_sizes()) {
        CHECK(met > 3000);
        CHECK(missed > 3000);
        CHECK(enclosed > 500);
    }
}

TEST_CASE("influence: the box around a region is rounded outwards where the origin cancels its corners") {
    using Vector = glm::vec<3, long double>;
    const auto wide = [](const float* v) { return Vector(v[0], v[1], v[2]); };
    Random random(94);
    for (int i = 0; i < (small_sizes() ? 100 : 20000); ++i) {
        InfluenceRecord area = random_area(random, i % 2 == 1, 1);
        for (int k = 0; k < 3; ++k) area.origin[k] = -area.far * area.forward[k];
        if (i % 4 < 2) // then corners, not the middle of the far face
            for (int k = 0; k < 3; ++k)
                area.origin[k] -= (area.point != 0 ? area.far : 1) *
                                  (area.half_width * area.right[k] + area.half_height * area.up[k]);
        const glm::mat<3, 3, long double> world = glm::inverse(
            glm::transpose(glm::mat<3, 3, long double>(wide(area.right), wide(area.up), wide(area.forward))));
        const Aabb box = enclosing_box(area);
        for (int c = 0; c < 8; ++c) {
            const long double depth = c < 4 ? area.near : area.far, unit = area.point != 0 ? depth : 1;
            const Vector local((c & 1 ? 1 : -1) * unit * area.half_width, (c & 2 ? 1 : -1) * unit * area.half_height,
                               depth);
            const Vector corner = wide(area.origin) + world * local;
            for (int k = 0; k < 3; ++k) {
                CHECK(box.min[k] <= corner[k]);
                CHECK(box.max[k] >= corner[k]);
            }
        }
    }
}

TEST_CASE("influence: boxes that touch a region meet it, and those a float away do not") {
    // All numbers here are exact.
    const InfluenceRecord plane = make_area(false, {0, 0, 0}, {0, 0, -1}, 1, 2, 0, 4);
    const InfluenceRecord point = make_area(true, {0, 0, 0}, {0, 0, -1}, 1, 1, 1, 4);
    const Aabb beside = {{1, -1, -2}, {2, 1, -1}}, corner = {{1, 2, 0}, {2, 3, 1}}, behind = {{0, 0, -5}, {0, 0, -4}};
    for (const Aabb& box : {beside, corner, behind}) CHECK(intersects(plane, box));
    Aabb moved = beside;
    moved.min[0] = std::nextafter(1.0f, 2.0f);
    CHECK(!intersects(plane, moved));
    moved = corner;
    moved.min[2] = 0x1p-24f; // one float from the extents
    CHECK(!intersects(plane, moved));
    moved = behind;
    moved.max[2] = std::nextafter(-4.0f, -5.0f);
    CHECK(!intersects(plane, moved));

    const Aabb edge = {{3, -1, -3}, {5, 1, -2}}, tip = {{0, 0, -1}, {0, 0, 0}};
    CHECK(intersects(point, edge)); // at (3, 0, -3)
    CHECK(intersects(point, tip));
    moved = edge;
    moved.min[0] = std::nextafter(3.0f, 4.0f);
    CHECK(!intersects(point, moved));
    moved = tip;
    moved.min[2] = std::nextafter(-1.0f, 0.0f);
    CHECK(!intersects(point, moved));

    CHECK(contains(plane, {1, 2, -4}));
    CHECK(!contains(plane, {1, 2, std::nextafter(-4.0, -5.0)}));
    CHECK(contains(point, {4, -4, -4}));
    CHECK(!contains(point, {std::nextafter(4.0, 5.0), -4, -4}));
    CHECK(!contains(point, {0, 0, 2})); // behind the eye
    CHECK(encloses(plane, Aabb{{-1, -2, -4}, {1, 2, 0}}));
    CHECK(!encloses(plane, Aabb{{-1, -2, -4}, {1, 2, std::numeric_limits<float>::min()}}));
    CHECK(encloses(point, Aabb{{-2, -2, -4}, {2, 2, -2}}));
    CHECK(corners(plane)[0] == glm::dvec3(-1, -2, 0));
    CHECK(corners(plane)[5] == glm::dvec3(1, -2, -4));
    CHECK(corners(point)[2] == glm::dvec3(-1, 1, -1));
    CHECK(corners(point)[7] == glm::dvec3(4, 4, -4));
    const Aabb empty = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    CHECK(!intersects(plane, empty));
    CHECK(!intersects(point, empty));
    CHECK(!encloses(plane, empty));
}

TEST_SUITE_END();
