// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "boxwood/influence.hpp"
#include "influence/random_areas.hpp"
#include "runtime/launch.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("build");

namespace {

constexpr double e = 0x1p-24;

struct Ray {
    InfluenceRecord area;
    float origin[3];
    float direction[3];
};

struct Answers {
    std::vector<float> exits;
    std::vector<std::uint32_t> flags;
};

Answers ask(const std::vector<Ray>& rays) {
    std::vector<InfluenceRecord> areas;
    std::vector<float> origins, directions;
    for (const Ray& ray : rays) {
        areas.push_back(ray.area);
        origins.insert(origins.end(), ray.origin, ray.origin + 3);
        directions.insert(directions.end(), ray.direction, ray.direction + 3);
    }
    Device& device = test_device();
    const Guarded<float> exits(device, rays.size());
    const Guarded<std::uint32_t> flags(device, rays.size());
    launch(device, {"influence/influence_test.cl", "influence_test"}, "influence test", rays.size(),
           upload(device, areas, "areas"), upload(device, origins, "origins"), upload(device, directions, "directions"),
           exits.view(), flags.view(), static_cast<std::uint32_t>(rays.size()));
    CHECK(exits.intact());
    CHECK(flags.intact());
    return {exits.values(), flags.values()};
}

glm::dvec3 vector(const float* v) { return {v[0], v[1], v[2]}; }

/// Room to each side of the region, positive inside, by the record's floats: near, far, and four sides.
std::array<double, 6> rooms(const InfluenceRecord& area, const glm::dvec3& point) {
    const glm::dvec3 d = point - vector(area.origin);
    const double x = glm::dot(d, vector(area.right)), y = glm::dot(d, vector(area.up)),
                 z = glm::dot(d, vector(area.forward));
    const double unit = area.point != 0 ? z : 1;
    return {z - area.near,
            area.far - z,
            unit * area.half_width - x,
            unit * area.half_width + x,
            unit * area.half_height - y,
            unit * area.half_height + y};
}

/// How fast these rooms grow along a direction.
std::array<double, 6> growths(const InfluenceRecord& area, const glm::dvec3& d) {
    const double x = glm::dot(d, vector(area.right)), y = glm::dot(d, vector(area.up)),
                 z = glm::dot(d, vector(area.forward));
    const double unit = area.point != 0 ? z : 0;
    return {z,
            -z,
            unit * area.half_width - x,
            unit * area.half_width + x,
            unit * area.half_height - y,
            unit * area.half_height + y};
}

/// The distance at which a ray leaves the region; it is inside, or outside by rounding.
double true_exit(const Ray& ray) {
    const std::array<double, 6> at = rooms(ray.area, vector(ray.origin));
    const std::array<double, 6> growth = growths(ray.area, vector(ray.direction));
    double time = INFINITY;
    for (std::size_t k = 0; k < 6; ++k)
        if (growth[k] < 0) time = std::min(time, std::max(at[k], 0.0) / -growth[k]);
    return time;
}

/// Rays from points inside, on sides, edges and corners, outside and a little outside; along the area, back, along its
/// sides, and anywhere; of all lengths.
std::vector<Ray> random_rays(std::size_t count) {
    Random random(95);
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < count; ++i) {
        const double scale = std::exp2(i % 8 == 0 ? double(random.below(117)) - 58 : 0);
        Ray ray;
        ray.area = random_area(random, i % 2 == 1, scale);
        const std::uint32_t kind = random.below(4);
        glm::dvec3 share(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0, 1));
        for (std::uint32_t k = 0; k < kind; ++k) share[static_cast<int>(random.below(3))] = random.below(2);
        if (random.below(8) == 0) share *= 1 + random.uniform(0, 1e-4f);
        const double depth = ray.area.near + share.z * (double(ray.area.far) - ray.area.near),
                     unit = ray.area.point != 0 ? depth : 1;
        const glm::dmat3 world = glm::transpose(exact_frame(ray.area));
        const glm::dvec3 local(share.x * unit * ray.area.half_width, share.y * unit * ray.area.half_height, depth);
        const glm::dvec3 origin = vector(ray.area.origin) + world * local;
        glm::dvec3 direction = random_vector(random, 1);
        if (random.below(2) == 0) direction = ray.area.point != 0 ? glm::normalize(world * local) : world[2];
        if (random.below(3) == 0) direction = -direction;
        if (random.below(6) == 0) direction = world[static_cast<int>(random.below(3))];
        direction *= std::exp2(i % 4 == 0 ? double(random.below(200)) - 100 : 0);
        for (int k = 0; k < 3; ++k) {
            ray.origin[k] = static_cast<float>(origin[k]);
            ray.direction[k] = static_cast<float>(direction[k]);
        }
        rays.push_back(ray);
    }
    // Leaves after a time of few digits, in units of a direction that makes it an ordinary number.
    rays.push_back(
        {make_area(false, {0, 0, 0}, {0, 0, 1}, 1, 1, 0, 1), {0, 0, 0x1p-140f}, {0x1p-23f, 0, -0.55f * 0x1p-23f}});
    return rays;
}

} // namespace

TEST_CASE("area_rays: a ray is in the region of an area up to its exit, and not much shorter than that") {
    const std::vector<Ray> rays = random_rays(small_sizes() ? 100 : 40000);
    const Answers found = ask(rays);
    std::size_t inside = 0, outside = 0, close = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Ray& ray = rays[i];
        INFO("ray " << i);
        const glm::dvec3 from = vector(ray.origin) - vector(ray.area.origin), direction = vector(ray.direction);
        const double size = std::abs(from.x) + std::abs(from.y) + std::abs(from.z);
        const double tangent = ray.area.point != 0 ? std::max(ray.area.half_width, ray.area.half_height) : 0;
        const std::array<double, 6> room = rooms(ray.area, vector(ray.origin));
        const double least = *std::min_element(room.begin(), room.end());
        const bool contained = (found.flags[i] & 1) != 0;
        if (least >= 0) CHECK(contained);
        if (contained) CHECK(least >= -24 * e * size * (1 + tangent));
        (contained ? inside : outside)++;
        if (!contained) continue;
        const double exit = found.exits[i], leaves = true_exit(ray);
        CHECK(exit >= 0);
        CHECK(exit <= leaves);
        // What it gives away: 60 roundings of the room to each side and of the speed, which may be small.
        const double speed = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
        double allowed = double(std::numeric_limits<float>::max());
        const std::array<double, 6> growth = growths(ray.area, direction);
        for (std::size_t k = 0; k < 6; ++k) {
            const double faster = -growth[k] + 60 * e * speed * (1 + tangent);
            const double extent =
                k < 2 || ray.area.point != 0 ? ray.area.far : std::max(ray.area.half_width, ray.area.half_height);
            const double less = room[k] - 60 * e * (size + extent) * (1 + tangent);
            if (faster > 0) allowed = std::min(allowed, std::max(less, 0.0) / faster * (1 - 60 * e));
        }
        CHECK(exit >= allowed - 0x1p-125 / std::min(speed, 1.0)); // below it is 0
        close += exit > 0.999 * leaves;
    }
    if (!small_sizes()) {
        CHECK(inside > rays.size() / 2);
        CHECK(outside > rays.size() / 100);
        CHECK(close > rays.size() / 4);
    }
}

TEST_CASE("area_rays: directions that are affine to an area: along its lines either way, within the tolerance") {
    Random random(96);
    std::vector<Ray> rays;
    std::vector<int> expected; // 1: affine, 0: not
    for (int i = 0; i < (small_sizes() ? 100 : 20000); ++i) {
        const double scale = std::exp2(double(random.below(117)) - 58);
        Ray ray;
        ray.area = random_area(random, i % 2 == 1, scale);
        const double degrees[] = {0, 0.001, 0.5, 10, 90}, tolerance = degrees[random.below(5)];
        ray.area.sin_tolerance = static_cast<float>(std::sin(glm::radians(tolerance)));
        const glm::dvec3 origin = random_vector(random, 10 * scale);
        for (int k = 0; k < 3; ++k) ray.origin[k] = static_cast<float>(origin[k]);
        const glm::dvec3 own = glm::normalize(ray.area.point != 0 ? vector(ray.origin) - vector(ray.area.origin)
                                                                  : vector(ray.area.forward));
        const glm::dvec3 aside = glm::normalize(glm::cross(own, random_vector(random, 1)));
        const bool affine = random.below(2) == 0 || tolerance == 90;
        // Outside or inside by a hundredth, and by the rounding of directions.
        const double angle = affine ? std::max(glm::radians(tolerance) * 0.99 * random.uniform(0, 1), 0.0)
                                    : glm::radians(tolerance) * (1.01 + random.uniform(0, 1)) + 16 * e;
        const double length = std::exp2(double(random.below(240)) - 120);
        const glm::dvec3 direction =
            (std::cos(angle) * own + std::sin(angle) * aside) * (random.below(2) == 0 ? length : -length);
        for (int k = 0; k < 3; ++k) ray.direction[k] = static_cast<float>(direction[k]);
        rays.push_back(ray);
        expected.push_back(affine ? 1 : 0);
    }
    Ray zero = rays[0], eye = rays[1];
    for (int k = 0; k < 3; ++k) zero.direction[k] = 0;
    for (int k = 0; k < 3; ++k) eye.origin[k] = eye.area.origin[k];
    rays.insert(rays.end(), {zero, eye});
    expected.insert(expected.end(), {0, 1});
    const Answers found = ask(rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        INFO("ray " << i);
        CHECK((found.flags[i] >> 1 & 1) == static_cast<std::uint32_t>(expected[i]));
    }
    CHECK(found.exits[rays.size() - 2] == 0.0f);
}

TEST_SUITE_END();
