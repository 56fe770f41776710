// SPDX-License-Identifier: MIT
// Trees with influence areas against brute force and against the tree without them: equal bits are asked for.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "boxwood/build.hpp"
#include "boxwood/error.hpp"
#include "boxwood/gltf.hpp"
#include "boxwood/influence.hpp"
#include "boxwood/procedural.hpp"
#include "boxwood/update.hpp"
#include "oracles/brute_force.hpp"
#include "traverse/area_checks.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("traverse");

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

struct Bounds3 {
    glm::dvec3 low, high;

    glm::dvec3 at(const glm::dvec3& share) const { return low + share * (high - low); }
    double size() const { return std::max({high.x - low.x, high.y - low.y, high.z - low.z}); }
};

Bounds3 bounds_of(const Scene& scene) {
    Bounds3 bounds{glm::dvec3(infinity), glm::dvec3(-infinity)};
    for (const Instance& instance : scene.instances) {
        for (const glm::vec3& p : scene.meshes[instance.mesh].positions) {
            const glm::dvec3 placed(glm::dmat4(instance.transform) * glm::dvec4(p, 1.0));
            bounds.low = glm::min(bounds.low, placed);
            bounds.high = glm::max(bounds.high, placed);
        }
    }
    return bounds;
}

glm::dvec3 random_vector(Random& random) {
    const double x = random.uniform(-1.0f, 1.0f), y = random.uniform(-1.0f, 1.0f);
    return {x, y, random.uniform(-1.0f, 1.0f)};
}

/// Planes along an axis and askew, points outside and within; regions that cut the scene, overlap, and lie beside it.
std::vector<InfluenceArea> sample_areas(const Bounds3& bounds) {
    const double size = bounds.size();
    const auto plane = [&](const glm::dvec3& at, const glm::dvec3& direction, double half, double far) {
        InfluenceArea area;
        area.origin = bounds.at(at);
        area.direction = direction;
        area.half_width = half * size;
        area.half_height = 0.7 * half * size;
        area.far = far * size;
        return area;
    };
    const auto point = [&](const glm::dvec3& at, const glm::dvec3& direction, double tangent, double far) {
        InfluenceArea area = plane(at, direction, 1.0, far);
        area.kind = AreaKind::point;
        area.half_width = tangent;
        area.half_height = 0.6 * tangent;
        area.near = 0.01 * size;
        return area;
    };
    return {plane({0.5, 0.5, -0.1}, {0, 0, 1}, 0.2, 0.7), plane({0.3, 1.1, 0.4}, {0.3, -1, 0.2}, 0.3, 0.9),
            point({0.5, 0.4, 0.9}, {0.1, 0.05, -1}, 0.5, 0.8), point({-0.2, 0.6, 0.5}, {1, -0.2, 0.0}, 0.3, 2.0),
            plane({5.0, 5.0, 5.0}, {1, 0, 0}, 0.1, 0.1)}; // without a triangle
}

/// Rays that start in an area, on its faces or anywhere, follow it, nearly do, run along a face, or go anywhere.
std::vector<Ray> area_rays(Random& random, const std::vector<InfluenceArea>& areas, const Bounds3& bounds,
                           std::uint32_t count) {
    const std::vector<InfluenceRecord> records = influence_records(areas);
    std::vector<Ray> rays;
    for (std::uint32_t i = 0; i < count; ++i) {
        const InfluenceRecord& record = records[random.below(static_cast<std::uint32_t>(records.size()))];
        const glm::dvec3 eye(record.origin[0], record.origin[1], record.origin[2]);
        const glm::dvec3 forward(record.forward[0], record.forward[1], record.forward[2]);
        const auto place = [&](double x, double y, double z) {
            const auto corner = corners(record);
            const auto mix = [](const glm::dvec3& a, const glm::dvec3& b, double t) { return a + t * (b - a); };
            const auto face = [&](int first) {
                return mix(mix(corner[first], corner[first + 1], x), mix(corner[first + 2], corner[first + 3], x), y);
            };
            return mix(face(0), face(4), z);
        };
        double share[3];
        for (double& s : share) s = random.uniform(0.0f, 1.0f);
        const bool on_face = random.below(4) == 0;
        if (on_face) share[random.below(3)] = random.below(2);
        if (random.below(3) == 0) share[2] = 0.0; // where the area's rays leave
        glm::dvec3 origin = place(share[0], share[1], share[2]);
        if (record.point && random.below(4) == 0) origin = eye;
        const glm::dvec3 own = record.point && origin != eye ? glm::normalize(origin - eye) : forward;
        glm::dvec3 direction = own;
        switch (random.below(6)) {
        case 0:
            direction = random_vector(random);
            break; // anywhere
        case 1:
            direction = own + 0.005 * random_vector(random);
            break; // about the tolerance
        case 2:
            origin = bounds.at(0.5 + random_vector(random));
            break; // parallel, from anywhere
        case 3:
            direction = place(share[0], 0.0, 1.0) - place(share[0], 0.0, 0.0), origin = place(share[0], 0.0, 0.0);
            break;
        default:
            break;
        }
        if (origin == eye && record.point) direction = place(share[0], share[1], 1.0) - eye;
        direction *= std::exp2(static_cast<double>(random.below(9)) - 4.0);
        Ray ray = ray_of(origin, direction);
        if (random.below(3) == 0) ray.t_max = static_cast<float>(random.uniform(0.0f, 1.0f) * bounds.size());
        if (random.below(8) == 0) ray.t_min = static_cast<float>(random.uniform(0.0f, 0.3f) * bounds.size());
        rays.push_back(ray);
    }
    return rays;
}

} // namespace

TEST_CASE("areas: equal brute force on random triangles and instances") {
    Random random(50);
    for (const std::uint32_t triangles : {1u, 9u, 1000u}) {
        CAPTURE(triangles);
        const Scene scene = single(random_mesh(random, small_sizes() ? 9 : triangles, triangles < 10 ? 0.8f : 0.2f));
        const Bounds3 bounds = bounds_of(scene);
        const std::vector<InfluenceArea> areas = sample_areas(bounds);
        const std::vector<Ray> rays = area_rays(random, areas, bounds, ray_count(4000));
        const Searches found = check_areas(scene, areas, rays, BruteForce(scene, Levels::one).closest_hits(rays));
        if (small_sizes()) continue; // too few rays to ask for any share of them
        CHECK(found.local > rays.size() / 20);
        CHECK(found.continued > rays.size() / 40);
    }
    const Scene scene = instanced_scene(random, 3, small_sizes() ? 3 : 9, small_sizes() ? 4 : 40);
    const Bounds3 bounds = bounds_of(scene);
    const std::vector<InfluenceArea> areas = sample_areas(bounds);
    const std::vector<Ray> rays = area_rays(random, areas, bounds, ray_count(4000));
    check_areas(scene, areas, rays, BruteForce(scene, Levels::one).closest_hits(rays));
}

TEST_CASE("areas: equal brute force on the smallest and the largest scenes") {
    Random random(55);
    for (const float scale : {0x1p-50f, 0x1p50f}) {
        CAPTURE(scale);
        Mesh mesh = random_mesh(random, small_sizes() ? 9 : 300, 0.3f);
        for (glm::vec3& p : mesh.positions) p *= scale;
        const Scene scene = single(mesh);
        const Bounds3 bounds = bounds_of(scene);
        const std::vector<InfluenceArea> areas = sample_areas(bounds);
        std::vector<Ray> rays = area_rays(random, areas, bounds, ray_count(2000));
        for (Ray& ray : rays) { // as kernels do themselves, the oracle does not
            const float size =
                std::max({std::abs(ray.direction[0]), std::abs(ray.direction[1]), std::abs(ray.direction[2])});
            const float unit = std::exp2(std::floor(std::log2(size)));
            for (float& d : ray.direction) d /= unit;
            ray.t_min *= unit;
            ray.t_max *= unit;
        }
        const Searches found = check_areas(scene, areas, rays, BruteForce(scene, Levels::one).closest_hits(rays));
        if (!small_sizes()) CHECK(found.local > rays.size() / 20);
    }
}

TEST_CASE("areas: equal brute force where fields of view and tolerances are at their ends") {
    Random random(56);
    const Scene scene = single(random_mesh(random, small_sizes() ? 9 : 300, 0.3f));
    const Bounds3 bounds = bounds_of(scene);
    std::vector<InfluenceArea> areas = sample_areas(bounds);
    for (const double tangent : {0x1p-30, 0x1p-12, 0x1p12, 0x1p30}) {
        areas.push_back(areas[3]);
        areas.back().half_width = tangent;
    }
    areas.push_back(areas[0]);
    areas.back().half_width = areas.back().half_height = 0x1p-60;
    for (const double degrees : {0.0, 90.0}) {
        CAPTURE(degrees);
        for (InfluenceArea& area : areas) area.tolerance_degrees = degrees;
        const std::vector<Ray> rays = area_rays(random, areas, bounds, ray_count(2000));
        const Searches found = check_areas(scene, areas, rays, BruteForce(scene, Levels::one).closest_hits(rays));
        if (!small_sizes()) CHECK(found.local > rays.size() / 40);
    }
}

TEST_CASE("areas: equal the tree without areas on every procedural kind") {
    Random random(51);
    for (const ProceduralKind& kind : procedural_kinds()) {
        CAPTURE(kind.name);
        const Scene scene = make_procedural(kind.name, {small_sizes() ? 20u : 2000u, 4, test_seed()});
        const Bounds3 bounds = bounds_of(scene);
        const std::vector<InfluenceArea> areas = sample_areas(bounds);
        const std::vector<Ray> rays = area_rays(random, areas, bounds, ray_count(5000));
        check_areas(scene, areas, rays, trace(built(scene, Layout::wide8, {}), rays));
    }
}

TEST_CASE("areas: one without triangles is reported and leaves the tree as it is") {
    Random random(52);
    const Scene scene = single(random_mesh(random, 20, 0.5f));
    InfluenceArea area;
    area.origin = {50, 50, 50};
    BuildReport report;
    const TreeImage tree = built(scene, Layout::wide8, {area}, AreaIndexKind::automatic, &report);
    REQUIRE(report.areas.size() == 1);
    CHECK(report.areas[0].triangles == 0);
    CHECK(tree.areas.empty());
    CHECK(tree.area_index.nodes.empty());
    const TreeImage without = built(scene, Layout::wide8, {});
    CHECK(same_bits(tree.wide_nodes, without.wide_nodes));
    CHECK(same_bits(tree.blocks, without.blocks));
}

TEST_CASE("areas: two levels, oriented boxes and animation are refused") {
    Random random(53);
    const Scene scene = single(random_mesh(random, 20, 0.5f));
    BuildOptions options;
    options.areas = sample_areas(bounds_of(scene));
    options.levels = Levels::two;
    CHECK_THROWS_AS(build(test_device(), scene, options), InputError);
    options.levels = Levels::automatic;
    options.bounds.kind = Bounds::obb_points;
    CHECK_THROWS_AS(build(test_device(), scene, options), InputError);
    options.bounds.kind = Bounds::aabb;
    CHECK_THROWS_AS(AnimatedTree(test_device(), scene, options), InputError);
    CHECK_NOTHROW(build(test_device(), scene, options));
}

TEST_SUITE_END();
