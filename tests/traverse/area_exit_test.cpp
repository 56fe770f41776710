// SPDX-License-Identifier: MIT
// Hits about where a ray leaves the region of an influence area.
#include <doctest/doctest.h>

#include <cmath>

#include "oracles/brute_force.hpp"
#include "traverse/area_checks.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("traverse");

TEST_CASE("area_exit: a hit in the local tree beyond the region is not the closest") {
    // The region ends at z = 1. A slanted triangle begins in it and is met at z = 5; another, outside, at z = 2.
    Mesh mesh;
    mesh.positions = {{-4, -4, 0.5f}, {8, -4, 9.5f}, {-4, 8, 9.5f}, {-1, -1, 2}, {3, -1, 2}, {-1, 3, 2}};
    mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
    const Scene scene = single(mesh);
    InfluenceArea area;
    area.origin = {-2, -2, 0};
    area.direction = {0, 0, 1};
    area.half_width = area.half_height = 2.5;
    area.far = 1.0;
    area.tolerance_degrees = 90.0;
    BuildReport report;
    built(scene, Layout::wide8, {area}, AreaIndexKind::list, &report);
    REQUIRE(report.areas.size() == 1);
    REQUIRE(report.areas[0].triangles == 1);
    const std::vector<Ray> rays{ray_of({0, 0, 0.25}, {0, 0, 1}), ray_of({0.25, 0.125, 0}, {0, 0, 0.5}),
                                ray_of({-3.875, -3.875, 0.25}, {0, 0, 1})};
    const std::vector<Hit> expected = BruteForce(scene, Levels::one).closest_hits(rays);
    CHECK(expected[0].primitive == 1);
    CHECK(expected[1].primitive == 1);
    CHECK(expected[2].primitive == 0);
    const Searches found = check_areas(scene, {area}, rays, expected);
    CHECK(found.local == 1);
    CHECK(found.continued == 2);
}

TEST_CASE("area_exit: a grazed triangle just beyond the region is not lost") {
    // Rays along z graze a triangle at 2^-19: what they travel to it rounds by 2^19 times as much as its coordinates.
    // It begins at z = 1.005, farther from the region, which ends at 1, than local trees reach, and no hit may be said
    // to be before. A small one inside makes the tree.
    Random random(54);
    std::size_t beyond = 0, before = 0;
    for (int i = 0; i < (small_sizes() ? 2 : 20); ++i) {
        const double angle = random.uniform(0.0f, 6.28f), lean = 0x1p-19;
        const glm::dvec3 along(-std::sin(angle), std::cos(angle), 0.0),
            up(lean * std::cos(angle), lean * std::sin(angle), 1.0);
        const glm::dvec3 base(random.uniform(-0.5f, 0.5f), random.uniform(-0.5f, 0.5f), 1.005);
        Mesh mesh;
        for (const glm::dvec3& p : {base - 4.0 * along, base + 5.0 * along, base + along + 9.0 * up})
            mesh.positions.emplace_back(p);
        mesh.positions.insert(mesh.positions.end(), {{0.9f, 0.9f, 0.5f}, {0.95f, 0.9f, 0.5f}, {0.9f, 0.95f, 0.5f}});
        mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
        const Scene scene = single(mesh);
        InfluenceArea area;
        area.direction = {0, 0, 1};
        area.far = 1.0;
        std::vector<Ray> rays;
        for (std::uint32_t k = 0; k < ray_count(400); ++k) {
            glm::dvec3 hit =
                base + double(random.uniform(-0.4f, 0.4f)) * along + double(random.uniform(0.0f, 0.1f)) * up;
            hit.z = random.uniform(0.1f, 0.4f);
            rays.push_back(ray_of(hit, {0, 0, 1}));
        }
        const std::vector<Hit> expected = BruteForce(scene, Levels::one).closest_hits(rays);
        for (std::size_t k = 0; k < rays.size(); ++k)
            if (expected[k].primitive == 0) ++(expected[k].t + rays[k].origin[2] < 1.004f ? before : beyond);
        BuildReport report;
        built(scene, Layout::wide8, {area}, AreaIndexKind::list, &report);
        REQUIRE(report.areas[0].triangles == 1);
        check_areas(scene, {area}, rays, expected);
    }
    if (!small_sizes()) CHECK(beyond > 100);
    CHECK(before == 0);
}

TEST_CASE("area_exit: distances tied on the face where rays leave the region, the lowest primitive wins") {
    // Triangles in the plane z = 1, where the region ends, three times; rays reach it at t = 1 exactly.
    Mesh mesh;
    for (int copy = 0; copy < 3; ++copy) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), {{-1, -1, 1}, {3, -1, 1}, {-1, 3, 1}});
        mesh.triangles.emplace_back(first, first + 1, first + 2);
    }
    const Scene scene = single(mesh);
    InfluenceArea area;
    area.direction = {0, 0, 1};
    area.half_width = area.half_height = 0.5;
    area.far = 1.0;
    std::vector<Ray> rays;
    for (int i = -4; i <= 4; ++i)
        for (int j = -4; j <= 4; ++j) rays.push_back(ray_of({i / 8.0, j / 8.0, 0}, {0, 0, 1}));
    const std::vector<Hit> expected = BruteForce(scene, Levels::one).closest_hits(rays);
    CHECK(expected[40].primitive == 0);
    check_areas(scene, {area}, rays, expected);
}

TEST_SUITE_END();
