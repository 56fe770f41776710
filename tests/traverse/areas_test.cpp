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
#include "traverse/scenes.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("traverse");

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

Ray ray_of(const glm::dvec3& origin, const glm::dvec3& direction, float t_max = infinity) {
    const glm::vec3 o(origin), d(direction);
    return {{o.x, o.y, o.z}, 0.0f, {d.x, d.y, d.z}, t_max};
}

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

TreeImage built(const Scene& scene, Layout layout, const std::vector<InfluenceArea>& areas,
                AreaIndexKind index = AreaIndexKind::automatic, BuildReport* report = nullptr) {
    BuildOptions options;
    options.levels = Levels::one;
    options.layout = layout;
    options.areas = areas;
    options.area_index = index;
    return download(test_device(), build(test_device(), scene, options, report));
}

struct Searches {
    std::size_t local = 0;     ///< Rays that a local tree answered.
    std::size_t continued = 0; ///< Rays that went on to the global one.
};

/// Both layouts and every index; `expected` by brute force or from the tree without areas.
Searches check_areas(const Scene& scene, const std::vector<InfluenceArea>& areas, const std::vector<Ray>& rays,
                     const std::vector<Hit>& expected) {
    Searches searches;
    for (const Layout layout : {Layout::binary, Layout::wide8}) {
        for (const AreaIndexKind index : {AreaIndexKind::list, AreaIndexKind::octree, AreaIndexKind::kd}) {
            CAPTURE(std::string(name(layout)));
            CAPTURE(std::string(name(index)));
            const TreeImage tree = built(scene, layout, areas, index);
            CHECK_NOTHROW(validate(tree, scene, "tree"));
            std::vector<RayStatistics> statistics;
            CHECK(count_different(trace(tree, rays), expected) == 0);
            CHECK(count_different(trace(tree, rays, statistics), expected) == 0);
            const std::vector<std::uint32_t> any = trace_any(tree, rays);
            std::size_t disagreeing = 0;
            searches = {};
            for (std::size_t i = 0; i < rays.size(); ++i) {
                disagreeing += any[i] != (expected[i].primitive == BOXWOOD_NONE ? 0u : 1u);
                searches.local += statistics[i].areas == 2;
                searches.continued += statistics[i].areas == 1;
            }
            CHECK(disagreeing == 0);
        }
    }
    return searches;
}

std::uint32_t ray_count(std::uint32_t count) { return small_sizes() ? 60 : count; }

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

TEST_CASE("areas: a hit in the local tree beyond the region is not the closest") {
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

TEST_CASE("areas: a hit beyond the region that rounds to before the exit is not lost") {
    // Rays along z graze a triangle at 2^-19: what they travel to it rounds by 2^19 times as much as its coordinates. It begins at
    // z = 1.005, farther from the region, which ends at 1, than local trees reach. A small one inside makes the tree.
    Random random(54);
    std::size_t before = 0;
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
            before += expected[k].primitive == 0 && expected[k].t + rays[k].origin[2] < 0.999f;
        BuildReport report;
        built(scene, Layout::wide8, {area}, AreaIndexKind::list, &report);
        REQUIRE(report.areas[0].triangles == 1);
        check_areas(scene, {area}, rays, expected);
    }
    if (!small_sizes()) CHECK(before > 100);
}

TEST_CASE("areas: distances tied on the face where rays leave the region, the lowest primitive wins") {
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
