// SPDX-License-Identifier: MIT
// Rays and scenes at the ends of float: slivers, grazing rays, triangles of random bits, all scales, and rays from far
// away.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "boxwood/build.hpp"
#include "oracles/brute_force.hpp"
#include "oracles/closed_meshes.hpp"
#include "oracles/exact_ray.hpp"
#include "oracles/extreme_rays.hpp"
#include "oracles/reference_builder.hpp"
#include "traverse/scenes.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("traverse");

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

std::vector<BuildOptions> all_trees() {
    std::vector<BuildOptions> all;
    for (const Levels levels : {Levels::one, Levels::two})
        for (const Builder builder : {Builder::lbvh, Builder::sah, Builder::midpoint})
            for (const Layout layout : {Layout::wide8, Layout::binary}) all.push_back({levels, layout, builder});
    for (const Bounds bounds : all_bounds()) {
        if (bounds == Bounds::aabb) continue;
        all.push_back({Levels::one, Layout::binary});
        all.back().bounds.kind = bounds;
    }
    return all;
}

/// Every tree's hits, those of one level and of two each against brute force. Returns how many hits there are.
std::size_t check_trees(const Scene& scene, const std::vector<Ray>& rays) {
    Device& device = test_device();
    const std::vector<Hit> one = BruteForce(scene, Levels::one).closest_hits(rays);
    const std::vector<Hit> two = BruteForce(scene, Levels::two).closest_hits(rays);
    const Buffer<Ray> queries = upload(device, rays, "rays");
    Buffer<Hit> hits = make_buffer<Hit>(device, rays.size(), "hits");
    for (const BuildOptions& options : all_trees()) {
        CAPTURE(name(options.levels));
        CAPTURE(name(options.builder));
        CAPTURE(name(options.bounds.kind));
        closest_hit(device, build(device, scene, options), queries, hits);
        CHECK(count_different(download(device, hits), options.levels == Levels::one ? one : two) == 0);
    }
    std::size_t count = 0;
    for (const Hit& hit : one) count += hit.primitive != BOXWOOD_NONE;
    return count;
}

Ray ray_from(const glm::vec3& origin, const glm::vec3& direction) {
    return {{origin.x, origin.y, origin.z}, 0.0f, {direction.x, direction.y, direction.z}, infinity};
}

glm::vec3 direction_of(Random& random) {
    glm::vec3 v;
    do {
        for (int k = 0; k < 3; ++k) v[k] = random.uniform(-1, 1);
    } while (glm::length(v) < 0.1f);
    return glm::normalize(v);
}

} // namespace

TEST_CASE("extremes: slivers and grazing rays, from near and from far away, the same from every tree") {
    for (const float aspect : {1.0f, 1e3f, 1e6f}) {
        const ExtremeRays made = sliver_rays(aspect, small_sizes() ? 4 : 60, small_sizes() ? 8 : 2400, test_seed());
        CAPTURE(made.name);
        CHECK(check_trees(made.scene, made.rays) > made.rays.size() / 50);
    }
}

TEST_CASE("extremes: triangles of random bits, the same from every tree") {
    const ExtremeRays made = random_bit_rays(small_sizes() ? 8 : 500, small_sizes() ? 8 : 4000, test_seed());
    check_trees(made.scene, made.rays);
}

TEST_CASE("extremes: a scene times 2^k from -120 to 58 gives the same hits") {
    // Coordinates of 8 bits, which stay whole at 2^-120 and below.
    Random random(83);
    Mesh mesh;
    const auto eighth = [&] { return static_cast<float>(static_cast<int>(random.below(256)) - 128) * 0x1p-7f; };
    for (std::uint32_t i = 0; i < (small_sizes() ? 8u : 300u); ++i) {
        const glm::vec3 middle(eighth(), eighth(), eighth());
        for (int k = 0; k < 3; ++k) mesh.positions.push_back(middle + 0.25f * glm::vec3(eighth(), eighth(), eighth()));
        mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    std::vector<Ray> rays;
    for (std::uint32_t i = 0; i < (small_sizes() ? 16u : 2000u); ++i) {
        const glm::vec3 origin(2 * eighth(), 2 * eighth(), 2 * eighth()), target(eighth(), eighth(), eighth());
        if (origin != target) rays.push_back(ray_from(origin, target - origin));
    }
    const auto scaled = [](const glm::vec3& p, int k) {
        return glm::vec3(std::ldexp(p.x, k), std::ldexp(p.y, k), std::ldexp(p.z, k));
    };
    Device& device = test_device();
    std::vector<BuildOptions> trees = {{Levels::one, Layout::wide8, Builder::lbvh},
                                       {Levels::one, Layout::binary, Builder::sah},
                                       {Levels::two, Layout::wide8, Builder::sah},
                                       {Levels::one, Layout::binary}};
    trees.back().bounds.kind = Bounds::obb_moments;
    for (const BuildOptions& options : trees) {
        std::vector<Hit> expected;
        for (const int k : {0, -120, -100, -64, -56, -50, 30, 58}) {
            CAPTURE(k);
            Mesh other = mesh;
            for (glm::vec3& p : other.positions) p = scaled(p, k);
            std::vector<Ray> moved = rays;
            for (Ray& ray : moved)
                for (int axis = 0; axis < 3; ++axis) {
                    ray.origin[axis] = std::ldexp(ray.origin[axis], k);
                    ray.direction[axis] = std::ldexp(ray.direction[axis], k);
                }
            const Guarded<Hit> hits(device, rays.size());
            closest_hit(device, build(device, single(other), options), upload(device, moved, "rays"), hits.view());
            if (k == 0) expected = hits.values();
            CHECK(count_different(hits.values(), expected) == 0);
        }
        std::size_t found = 0;
        for (const Hit& hit : expected) found += hit.primitive != BOXWOOD_NONE;
        if (!small_sizes()) CHECK(found > rays.size() / 8);
    }
}

TEST_CASE("extremes: rays from far away hit what exact arithmetic says and cost what near ones do") {
    const ClosedScene closed = make_closed({"", small_sizes() ? 4u : 40u, small_sizes() ? 6u : 60u});
    const std::vector<Corners> triangles = corners(closed.scene.meshes[0]);
    Device& device = test_device();
    const Tree tree = build(device, closed.scene);
    const std::uint32_t count = small_sizes() ? 10 : 300;
    double near_volumes = 0.0;
    for (const float away : {4.0f, 1e3f, 1e5f, 1e7f, 1e12f, 1e18f}) {
        CAPTURE(away);
        // Origins are multiples of a direction of few bits, so that they are exactly on one line with those 4 of it
        // away.
        const float step = std::exp2(std::round(std::log2(away)));
        Random random(84); // the same lines from everywhere
        std::vector<Ray> rays, near;
        for (std::uint32_t i = 0; i < count; ++i) {
            glm::vec3 d(static_cast<float>(random.below(15)) - 7.0f, static_cast<float>(random.below(15)) - 7.0f, 8.0f);
            d *= 0.125f;
            rays.push_back(ray_from(-step * d, d));
            near.push_back(ray_from(-4.0f * d, d));
        }
        const Buffer<Ray> queries = upload(device, rays, "rays");
        const Guarded<Hit> hits(device, rays.size());
        const Guarded<RayStatistics> statistics(device, rays.size());
        closest_hit(device, tree, queries, hits.view(), statistics.view());
        double volumes = 0.0;
        for (const RayStatistics& each : statistics.values()) volumes += each.volumes;
        if (near_volumes == 0.0) near_volumes = volumes;
        CHECK(volumes <= 1.1 * near_volumes);
        const std::vector<Hit> found = hits.values();
        for (std::uint32_t i = 0; i < count; ++i) {
            CAPTURE(i);
            const ExactHit exact = exact_hit(near[i], triangles);
            REQUIRE(exact.t > 0);
            REQUIRE(found[i].primitive != BOXWOOD_NONE);
            const __float128 t = exact.t + (__float128{step} - 4);
            CHECK(std::fabs(static_cast<double>((found[i].t - t) / t)) <= 0x1p-22);
        }
    }
}

TEST_CASE("extremes: t is that of the plane to a few units in the last place, and exact on a lattice") {
    Random random(85);
    const std::uint32_t count = small_sizes() ? 40 : 4000;
    const auto whole = [&](int reach) {
        return static_cast<float>(static_cast<int>(random.below(2 * reach + 1)) - reach);
    };
    // Triangles z = const and x + y + z = const of whole numbers; rays between lattice points through points of them.
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::vec3 p(whole(8), whole(8), whole(8));
        const glm::vec3 e = i % 2 == 0 ? glm::vec3(8, 0, 0) : glm::vec3(8, -8, 0);
        const glm::vec3 f = i % 2 == 0 ? glm::vec3(0, 8, 0) : glm::vec3(8, 0, -8);
        const Mesh one{"", {p, p + e, p + f}, {{0, 1, 2}}};
        const glm::vec3 hit = p + 0.25f * e + 0.5f * f, d(whole(3), whole(3), whole(3) * 2.0f + 7.0f);
        const Ray ray{{hit.x - 4 * d.x, hit.y - 4 * d.y, hit.z - 4 * d.z}, 0.0f, {d.x, d.y, d.z}, 4.0f};
        if (std::fabs(glm::dot(d, glm::cross(e, f))) == 0.0f) continue;
        const Hit found = BruteForce(single(one), Levels::one).closest_hit(ray);
        CHECK(found.t == 4.0f);
    }
    // Steep triangles of about the size of their distance: the bound is that of cl/traverse/ray_triangle.h.
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::vec3 d = direction_of(random), side = glm::normalize(glm::cross(d, direction_of(random)));
        const glm::vec3 up = glm::cross(d, side), middle = 3.0f * d;
        const Mesh one{"", {middle - side - 0.5f * up, middle + side + 0.3f * d - 0.4f * up, middle + up}, {{0, 1, 2}}};
        const Ray ray = ray_from({0, 0, 0}, d);
        const Hit found = BruteForce(single(one), Levels::one).closest_hit(ray);
        const ExactIntersection exact = exact_intersection(ray, corners(one)[0]);
        REQUIRE((found.primitive == 0) == exact.inside);
        if (exact.inside) CHECK(std::fabs(static_cast<double>(found.t - exact.t)) <= 8 * 0x1p-22);
    }
}

TEST_CASE("extremes: t_min of negative zero is zero, and the least t above it is not lost") {
    Mesh mesh;
    mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    const Scene scene = single(mesh);
    Device& device = test_device();
    // A direction so long that the distance underflows: the hit is still beyond t_min.
    const std::vector<Ray> rays{{{0, 0, -1}, -0.0f, {0, 0, 1}, infinity},
                                {{0, 0, -1e-10f}, 0.0f, {0, 0, 3e38f}, infinity},
                                {{0, 0, -1}, 1.0f, {0, 0, 1}, infinity}};
    for (const Layout layout : {Layout::wide8, Layout::binary}) {
        const Tree tree = build(device, scene, {Levels::one, layout});
        const Guarded<Hit> hits(device, rays.size());
        closest_hit(device, tree, upload(device, rays, "rays"), hits.view());
        const std::vector<Hit> found = hits.values();
        CHECK(found[0].t == 1.0f);
        CHECK(found[1].primitive == 0);
        CHECK(found[1].t > 0.0f);
        CHECK(found[2].primitive == BOXWOOD_NONE);
    }
    Random random(86);
    const Scene many = single(random_mesh(random, small_sizes() ? 50 : 2000, 0.1f));
    std::vector<Ray> zero = random_rays(random, small_sizes() ? 20 : 500, 1.0f), negative;
    for (Ray& ray : zero) ray.t_min = 0.0f;
    negative = zero;
    for (Ray& ray : negative) ray.t_min = -0.0f;
    std::vector<RayStatistics> expected, counted;
    const TreeImage tree = reference_tree(many, Layout::wide8, Levels::one);
    const std::vector<Hit> hits = trace(tree, zero, expected);
    CHECK(count_different(trace(tree, negative, counted), hits) == 0);
    CHECK(same_bits(counted, expected));
}

TEST_SUITE_END();
