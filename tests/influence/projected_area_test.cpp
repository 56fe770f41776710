// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "influence/random_areas.hpp"
#include "oracles/projection.hpp"
#include "runtime/launch.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("influence");

namespace {

const std::string file = "influence/projected_area_test.cl";
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

std::vector<float> probabilities(const std::vector<Case>& cases) {
    return run<float>("probability_test", 2 * cases.size(), cases.size(),
                      upload(test_device(), areas_of(cases), "areas"), upload(test_device(), boxes_of(cases), "boxes"));
}

/// How far apart a probability and the reference may be (projected_area.h), and the references for depths a little to
/// both sides.
struct Allowed {
    double least[2], most[2];
    bool sum[2];   ///< The faces were summed: the error is relative.
    double border; ///< Length of the outline times the size of what its corners' errors are relative to.
};

Allowed allowed(const Case& c) {
    const InfluenceRecord& area = c.area;
    double ratio = 1, far = 0, nearest = INFINITY;
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 p =
            area_coordinates(area, glm::dvec3((i & 1 ? c.box.max : c.box.min)[0], (i & 2 ? c.box.max : c.box.min)[1],
                                              (i & 4 ? c.box.max : c.box.min)[2]));
        far = std::max(far, glm::length(p));
        nearest = std::min(nearest, p.z);
        if (area.point != 0) ratio = std::max(ratio, glm::length(p) / std::max(p.z, double(area.near)));
    }
    const double shift = 6 * e * far; // what depths are off by
    const bool beyond = nearest - shift >= area.near;
    double place = 0;
    for (const glm::dvec2& p : projection(area, c.box, area.near))
        place = std::max({place, std::abs(p.x), std::abs(p.y)});
    Allowed result;
    const Polygon outline = projection(area, c.box, area.near);
    result.border = 0;
    for (std::size_t i = 0; i < outline.size(); ++i)
        result.border += glm::length(outline[i] - outline[(i + 1) % outline.size()]) * ratio * (1 + place);
    for (int culled = 0; culled < 2; ++culled) {
        const double a = reference_probability(area, c.box, culled != 0, area.near + shift);
        const double b = reference_probability(area, c.box, culled != 0, area.near - shift);
        const double at = reference_probability(area, c.box, culled != 0, area.near);
        result.sum[culled] = beyond && (culled == 0 || place < 1);
        const double unit = area.point != 0 ? std::max(nearest, double(area.near)) : 1.0;
        const double d = e * (8 * far / (unit * std::min(area.half_width, area.half_height)) +
                              (area.point != 0 ? 8 * ratio + 4 : 4) * place);
        const double reach = culled != 0 ? 1 : std::max(1.0, place);
        const double error =
            result.sum[culled] ? (20 * (area.point != 0 ? ratio : 0) + 24) * e * at : (3 * d + 20 * e * reach) * reach;
        result.least[culled] = std::min({a, b, at}) - error;
        result.most[culled] = std::max({a, b, at}) + error;
    }
    return result;
}

} // namespace

TEST_CASE("projected_area: the probability of a box is that of the hull of its corners, cut to the rectangle") {
    Random random(81);
    std::vector<Case> cases;
    const int count = small_sizes() ? 40 : 20000;
    for (int i = 0; i < count; ++i) {
        const double scale = std::exp2(i % 8 == 0 ? double(random.below(121)) - 60 : 0);
        const InfluenceRecord area = random_area(random, i % 2 == 1, scale);
        cases.push_back(
            {area, random_box(random, scale,
                              i % 3 == 0 ? random_vector(random, 4 * scale) : random_place(random, area, scale))});
    }
    const std::vector<float> found = probabilities(cases);
    std::size_t partial = 0, whole = 0, none = 0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const Allowed range = allowed(cases[i]);
        for (int culled = 0; culled < 2; ++culled) {
            const double value = found[2 * i + culled];
            INFO("case " << i << ", culled " << culled << ", summed " << range.sum[culled]);
            CHECK(value >= range.least[culled]);
            CHECK(value <= range.most[culled]);
        }
        (found[2 * i + 1] <= 0 ? none : found[2 * i + 1] < found[2 * i] ? partial : whole)++;
    }
    if (!small_sizes()) { // all ways were taken
        CHECK(none > cases.size() / 20);
        CHECK(partial > cases.size() / 20);
        CHECK(whole > cases.size() / 20);
    }
}

TEST_CASE("projected_area: the hull table has the outline of a box seen from anywhere") {
    // The 26 positions about a box, some of them close to it and some far; the outline is a hull that brute force
    // knows.
    std::vector<float> eyes;
    std::vector<Aabb> boxes;
    for (const float away : {0.01f, 1.0f, 40.0f})
        for (int i = 0; i < 27; ++i) {
            boxes.push_back({{-1, -2, -3}, {2, 1.5f, 1}});
            for (int k = 0, place = i; k < 3; ++k, place /= 3)
                eyes.push_back(place % 3 == 0   ? boxes.back().min[k] - away
                               : place % 3 == 1 ? boxes.back().max[k] + away
                                                : 0.25f * boxes.back().min[k]);
        }
    const std::vector<int> found = run<int>("table_test", 8 * boxes.size(), boxes.size(),
                                            upload(test_device(), eyes, "eyes"), upload(test_device(), boxes, "boxes"));
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const glm::dvec3 eye(eyes[3 * i], eyes[3 * i + 1], eyes[3 * i + 2]);
        std::vector<int> outline;
        for (int k = 0; k < 8 && found[8 * i + k] >= 0; ++k) outline.push_back(found[8 * i + k]);
        INFO("position " << i % 27 << " of " << i / 27);
        if (i % 27 == 26) { // inside
            CHECK(outline.empty());
            continue;
        }
        glm::dvec3 corner[8];
        for (int c = 0; c < 8; ++c)
            for (int k = 0; k < 3; ++k) corner[c][k] = (c >> k & 1 ? boxes[i].max : boxes[i].min)[k] - eye[k];
        // A cone from outside: every corner is on one side of the planes through the eye and the outline's edges.
        const std::size_t size = outline.size();
        REQUIRE((size == 4 || size == 6));
        double side = 0;
        for (std::size_t k = 0; k < size; ++k) {
            const int a = outline[k], b = outline[(k + 1) % size];
            CHECK(((a ^ b) & ((a ^ b) - 1)) == 0); // an edge of the box
            const glm::dvec3 normal = glm::cross(corner[a], corner[b]);
            for (int c = 0; c < 8; ++c) {
                if (c == a || c == b) continue;
                const double at = glm::dot(normal, corner[c]);
                CHECK(at != 0.0);
                if (side == 0) side = at;
                CHECK(at * side > 0);
            }
        }
    }
}

TEST_CASE("projected_area: the probability of a box is the share of random rays from the rectangle that meet it") {
    Random random(83);
    const int count = small_sizes() ? 6 : 60, rays = small_sizes() ? 2000 : 20000;
    std::vector<Case> cases;
    for (int i = 0; i < count; ++i) {
        const InfluenceRecord area = random_area(random, i % 2 == 1, 1);
        cases.push_back({area, random_box(random, 2, random_place(random, area, 1))});
    }
    const std::vector<float> found = probabilities(cases);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const InfluenceRecord& area = cases[i].area;
        const glm::dmat3 world = glm::transpose(exact_frame(area));
        int met = 0;
        for (int r = 0; r < rays; ++r) {
            const double unit = area.point != 0 ? area.near : 1;
            const glm::dvec3 start(random.uniform(-1, 1) * area.half_width * unit,
                                   random.uniform(-1, 1) * area.half_height * unit, area.near);
            const glm::dvec3 origin = glm::dvec3(area.origin[0], area.origin[1], area.origin[2]) + world * start;
            const glm::dvec3 direction = world * (area.point != 0 ? start : glm::dvec3(0, 0, 1));
            double enter = 0, leave = INFINITY;
            for (int k = 0; k < 3; ++k) {
                const double a = (cases[i].box.min[k] - origin[k]) / direction[k],
                             b = (cases[i].box.max[k] - origin[k]) / direction[k];
                if (direction[k] == 0 && (origin[k] < cases[i].box.min[k] || origin[k] > cases[i].box.max[k]))
                    leave = -1;
                if (direction[k] == 0) continue;
                enter = std::max(enter, std::min(a, b));
                leave = std::min(leave, std::max(a, b));
            }
            met += enter <= leave;
        }
        // Six standard deviations of a share, and one ray.
        const double p = found[2 * i + 1];
        INFO("case " << i << ": " << met << " of " << rays);
        CHECK(std::abs(met - p * rays) <= 6 * std::sqrt(p * (1 - p) * rays) + 1);
    }
}

TEST_CASE("projected_area: the measures add up the areas and the isotropic rays") {
    Random random(85);
    const Aabb root = {{-3, -2, -4}, {3, 5, 4}};
    std::vector<InfluenceRecord> areas;
    for (int i = 0; i < 5; ++i) {
        areas.push_back(random_area(random, i % 2 == 1, 1));
        areas.back().share = 0.05f * float(i);
    }
    std::vector<Aabb> boxes{root, {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}}};
    for (int i = 0; i < 100; ++i) boxes.push_back(random_box(random, 1, random_vector(random, 2)));
    const auto surface = [](const Aabb& b) {
        const double x = double(b.max[0]) - b.min[0], y = double(b.max[1]) - b.min[1], z = double(b.max[2]) - b.min[2];
        return x >= 0 && y >= 0 && z >= 0 ? x * y + y * z + z * x : 0;
    };
    Device& device = test_device();
    for (const std::uint32_t used : {5u, 1u, 0u}) { // area 0 alone has no share: areas then count alike
        const Guarded<float> out(device, 3 * boxes.size());
        launch(device, {file, "measure_test"}, "measures", boxes.size(), upload(device, areas, "areas"),
               upload(device, std::vector<Aabb>{root}, "root"), upload(device, boxes, "boxes"), out.view(), 0.5f, used,
               static_cast<std::uint32_t>(boxes.size()));
        const std::vector<float> found = out.values();
        CHECK(out.intact());
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            double projected = 0, shares = 0;
            for (std::uint32_t k = 0; k < used; ++k) {
                const double share = used == 1 ? 1 : areas[k].share;
                projected += i == 1 ? 0 : share * reference_probability(areas[k], boxes[i], true, areas[k].near);
                shares += share;
            }
            const double relative = std::min(surface(boxes[i]) / surface(root), 1.0);
            CHECK(found[3 * i] == doctest::Approx(relative).epsilon(1e-6));
            CHECK(found[3 * i + 1] ==
                  doctest::Approx(used == 0 ? relative : projected / shares).epsilon(1e-4).scale(1));
            CHECK(found[3 * i + 2] ==
                  doctest::Approx((used == 5 ? projected : 0) + 0.5 * relative).epsilon(1e-4).scale(1));
        }
    }
}

TEST_CASE("projected_area: probabilities at the extremes are in range, and those of the same shape at any size are the "
          "same") {
    Random random(86);
    std::vector<Case> cases;
    const int count = small_sizes() ? 10 : 2000;
    for (int i = 0; i < count; ++i) { // one shape at three sizes: powers of two change no digit
        const InfluenceRecord area = random_area(random, i % 2 == 1, 1);
        const Aabb box = random_box(random, 1, random_place(random, area, 1));
        for (const float scale : {1.0f, 0x1p-58f, 0x1p57f}) {
            Case c{area, box};
            for (int k = 0; k < 3; ++k) {
                c.area.origin[k] *= scale;
                c.box.min[k] *= scale;
                c.box.max[k] *= scale;
            }
            c.area.near *= scale;
            if (c.area.point == 0) c.area.half_width *= scale;
            if (c.area.point == 0) c.area.half_height *= scale;
            cases.push_back(c);
        }
    }
    const std::size_t scaled = cases.size();
    const float sizes[] = {0x1p-60f, 0x1p-20f, 1, 0x1p20f, 0x1p60f};
    for (const float area_size : sizes)
        for (const float box_size : sizes)
            for (int i = 0; i < (small_sizes() ? 1 : 60); ++i) {
                InfluenceRecord area = random_area(random, i % 2 == 1, area_size);
                if (i % 5 == 0) area.half_width *= i % 10 == 0 ? 0x1p-20f : 0x1p20f;
                cases.push_back({area, random_box(random, box_size,
                                                  i % 3 == 0 ? random_vector(random, 1e18)
                                                             : random_place(random, area, area_size))});
            }
    cases.push_back(
        {cases[0].area, {{-0x1p60f, -0x1p60f, -0x1p60f}, {0x1p60f, 0x1p60f, 0x1p60f}}}); // covers everything
    cases.push_back({cases[3].area, cases.back().box});
    const std::vector<float> found = probabilities(cases);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        INFO("case " << i);
        CHECK(found[2 * i] >= 0.0f);
        CHECK(found[2 * i] <= 0x1p60f);
        CHECK(found[2 * i + 1] >= 0.0f);
        CHECK(found[2 * i + 1] <= 1.0f);
        if (i < scaled && i % 3 != 0 &&
            found[2 * i] != found[2 * (i - i % 3)]) // what underflows on the way is beyond the claim
            CHECK(found[2 * i] == doctest::Approx(found[2 * (i - i % 3)]).epsilon(1e-6));
        if (i < scaled) CHECK(found[2 * i + 1] == doctest::Approx(found[2 * (i - i % 3) + 1]).epsilon(1e-6));
        if (i + 2 >= cases.size()) CHECK(found[2 * i + 1] == doctest::Approx(1.0));
    }
}

TEST_CASE("projected_area: an area's own ray through a point") {
    Random random(87);
    std::vector<InfluenceRecord> areas;
    std::vector<float> points;
    for (int i = 0; i < (small_sizes() ? 10 : 500); ++i) {
        const double scale = std::exp2(double(random.below(121)) - 60);
        areas.push_back(random_area(random, i % 2 == 1, scale));
        const glm::dvec3 p = random_vector(random, 4 * scale);
        for (int k = 0; k < 3; ++k) points.push_back(i % 20 == 1 ? areas.back().origin[k] : static_cast<float>(p[k]));
    }
    const std::vector<float> found =
        run<float>("direction_test", points.size(), areas.size(), upload(test_device(), areas, "areas"),
                   upload(test_device(), points, "points"));
    for (std::size_t i = 0; i < areas.size(); ++i) {
        glm::dvec3 way = exact_frame(areas[i])[0];
        for (int k = 0; k < 3; ++k) way[k] = double(points[3 * i + k]) - areas[i].origin[k];
        if (areas[i].point == 0 || i % 20 == 1) way = {areas[i].forward[0], areas[i].forward[1], areas[i].forward[2]};
        const glm::dvec3 got(found[3 * i], found[3 * i + 1], found[3 * i + 2]);
        CHECK(glm::length(got - glm::normalize(way)) <= 8 * e);
    }
}

TEST_SUITE_END();
