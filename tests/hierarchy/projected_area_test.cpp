// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "oracles/projection.hpp"
#include "runtime/launch.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("hierarchy");

namespace {

const std::string file = "hierarchy/projected_area_test.cl";
constexpr double e = 0x1p-24;

struct Case {
    InfluenceRecord area;
    Aabb box;
};

template <class T, class... Inputs>
std::vector<T> run(const char* kernel, std::size_t results, std::size_t count, const Inputs&... inputs) {
    const Guarded<T> out(test_device(), results);
    launch(test_device(), {file, kernel}, kernel, count, inputs..., out.view(), static_cast<std::uint32_t>(count));
    CHECK(out.intact());
    return out.values();
}

std::vector<InfluenceRecord> areas_of(const std::vector<Case>& cases) {
    std::vector<InfluenceRecord> areas;
    for (const Case& c : cases) areas.push_back(c.area);
    return areas;
}
std::vector<Aabb> boxes_of(const std::vector<Case>& cases) {
    std::vector<Aabb> boxes;
    for (const Case& c : cases) boxes.push_back(c.box);
    return boxes;
}

std::vector<float> chances(const std::vector<Case>& cases) {
    return run<float>("chance_test", 2 * cases.size(), cases.size(), upload(test_device(), areas_of(cases), "areas"),
                      upload(test_device(), boxes_of(cases), "boxes"));
}

glm::dvec3 random_vector(Random& random, double scale) {
    return scale * glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
}

/// Directions along axes, in their planes and oblique.
glm::dvec3 random_direction(Random& random) {
    glm::dvec3 v = random_vector(random, 1);
    const std::uint32_t kind = random.below(4);
    const std::uint32_t k = random.below(3);
    if (kind == 0) v[k] = v[(k + 1) % 3] = 0;
    if (kind == 1) v[k] = 0;
    return glm::length(v) > 0.01 ? v : glm::dvec3(1, 0, 0);
}

InfluenceRecord random_area(Random& random, bool point, double scale) {
    const double near = point ? scale * random.uniform(0.05f, 0.5f) : 0;
    const double size = point ? 1.0 : scale;
    return make_area(point, random_vector(random, scale), random_direction(random), size * random.uniform(0.2f, 1.5f),
                     size * random.uniform(0.2f, 1.5f), near, 10 * scale);
}

/// A box of random size, also flat, a line or a point, anywhere about the origin.
Aabb random_box(Random& random, double scale, double reach) {
    const glm::dvec3 centre = random_vector(random, scale * reach);
    glm::dvec3 half = glm::abs(random_vector(random, scale)) * std::exp2(-double(random.uniform(-1, 8)));
    for (int k = 0; k < 3; ++k)
        if (random.below(12) == 0) half[k] = 0;
    Aabb box;
    for (int k = 0; k < 3; ++k) {
        box.min[k] = static_cast<float>(centre[k] - half[k]);
        box.max[k] = static_cast<float>(centre[k] + half[k]);
    }
    return box;
}

/// How far apart a chance and the reference may be (projected_area.h), and the references for depths a little to both sides.
struct Allowed {
    double least[2], most[2];
    bool sum[2]; ///< The faces were summed: the error is relative.
};

Allowed allowed(const Case& c) {
    const InfluenceRecord& area = c.area;
    double ratio = 1, far = 0, nearest = INFINITY;
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 p = area_coordinates(area, glm::dvec3((i & 1 ? c.box.max : c.box.min)[0], (i & 2 ? c.box.max : c.box.min)[1],
                                                               (i & 4 ? c.box.max : c.box.min)[2]));
        far = std::max(far, glm::length(p));
        nearest = std::min(nearest, p.z);
        if (area.point != 0) ratio = std::max(ratio, glm::length(p) / std::max(p.z, double(area.near)));
    }
    const double shift = 6 * e * far; // what depths are off by
    const bool beyond = nearest - shift >= area.near;
    double place = 0;
    for (const glm::dvec2& p : projection(area, c.box, area.near)) place = std::max({place, std::abs(p.x), std::abs(p.y)});
    Allowed result;
    for (int culled = 0; culled < 2; ++culled) {
        const double a = reference_chance(area, c.box, culled != 0, area.near + shift);
        const double b = reference_chance(area, c.box, culled != 0, area.near - shift);
        const double at = reference_chance(area, c.box, culled != 0, area.near);
        result.sum[culled] = beyond && (culled == 0 || place < 1);
        const double unit = area.point != 0 ? std::max(nearest, double(area.near)) : 1.0;
        const double d = (14 * (area.point != 0 ? ratio : 1) + 6) * e * (place + far / (unit * std::min(area.half_width, area.half_height)));
        const double reach = culled != 0 ? 1 : std::max(1.0, place);
        const double error = result.sum[culled] ? (20 * (area.point != 0 ? ratio : 0) + 24) * e * at : (6 * d + 40 * e * reach) * reach;
        result.least[culled] = std::min({a, b, at}) - error;
        result.most[culled] = std::max({a, b, at}) + error;
    }
    return result;
}

} // namespace

TEST_CASE("the chance of a box is that of the hull of its corners, cut to the rectangle") {
    Random random(81);
    std::vector<Case> cases;
    const int count = small_sizes() ? 40 : 20000;
    for (int i = 0; i < count; ++i) {
        const double scale = std::exp2(i % 8 == 0 ? double(random.below(121)) - 60 : 0);
        const InfluenceRecord area = random_area(random, i % 2 == 1, scale);
        cases.push_back({area, random_box(random, scale, i % 3 == 0 ? 1 : 4)});
    }
    const std::vector<float> found = chances(cases);
    std::size_t partial = 0, whole = 0, none = 0;
    double worst[2] = {};
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const Allowed range = allowed(cases[i]);
        for (int culled = 0; culled < 2; ++culled) {
            const double value = found[2 * i + culled];
            INFO("case " << i << ", culled " << culled << ", summed " << range.sum[culled]);
            CHECK(value >= range.least[culled]);
            CHECK(value <= range.most[culled]);
            const double middle = (range.least[culled] + range.most[culled]) / 2, half = (range.most[culled] - range.least[culled]) / 2;
            if (half > 0) worst[range.sum[culled]] = std::max(worst[range.sum[culled]], std::abs(value - middle) / half);
        }
        (found[2 * i + 1] <= 0 ? none : found[2 * i + 1] < found[2 * i] ? partial : whole)++;
    }
    std::cerr << "worst of bound: outline " << worst[0] << ", sum " << worst[1] << "\n" << none << " " << partial << " " << whole << "\n";
    if (!small_sizes()) { // all ways were taken
        CHECK(none > cases.size() / 20);
        CHECK(partial > cases.size() / 20);
        CHECK(whole > cases.size() / 20);
    }
}

TEST_SUITE_END();
