// SPDX-License-Identifier: MIT
// Closed surfaces hold every ray, the same whatever the tree; boxwood-benchmark-watertight does it for as long as
// asked.
#include <doctest/doctest.h>

#include "boxwood/build.hpp"
#include "oracles/brute_force.hpp"
#include "oracles/closed_meshes.hpp"
#include "traverse/scenes.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("traverse");

namespace {

std::vector<Hit> hits_of(const Tree& tree, const std::vector<Ray>& rays, const TraceOptions& options = {}) {
    Device& device = test_device();
    const Guarded<Hit> hits(device, rays.size());
    closest_hit(device, tree, upload(device, rays, "rays"), hits.view(), options);
    CHECK(hits.intact());
    return hits.values();
}

std::size_t missed(const std::vector<Hit>& hits) {
    std::size_t count = 0;
    for (const Hit& hit : hits) count += hit.primitive == BOXWOOD_NONE;
    return count;
}

ClosedKind small_kind(const ClosedKind& kind) {
    ClosedKind smaller = kind;
    smaller.stacks = std::min(kind.stacks, small_sizes() ? 4u : 48u);
    smaller.slices = std::min(kind.slices, small_sizes() ? 6u : 64u);
    return smaller;
}

} // namespace

TEST_CASE("watertight: no ray gets out at edges, vertices or along axes, and all trees and brute force agree") {
    std::uint64_t seed = test_seed();
    for (const ClosedKind& kind : closed_kinds()) {
        const ClosedScene closed = make_closed(small_kind(kind));
        for (const Levels levels : {Levels::one, Levels::two}) {
            std::vector<Tree> trees;
            for (const Builder builder : {Builder::lbvh, Builder::sah})
                for (const Layout layout : {Layout::wide8, Layout::binary})
                    trees.push_back(build(test_device(), closed.scene, {levels, layout, builder}));
            for (const Bounds bounds : {Bounds::obb_points, Bounds::obb_quaternion}) {
                BuildOptions options{levels};
                options.bounds.kind = bounds;
                trees.push_back(build(test_device(), closed.scene, options));
            }
            const BruteForce brute(closed.scene, levels);
            for (const Aim aim : all_aims) {
                CAPTURE(kind.name);
                CAPTURE(name(levels));
                CAPTURE(static_cast<int>(aim));
                const auto rays = rays_from_inside(closed, aim, small_sizes() ? 20 : 1000, ++seed);
                const std::vector<Hit> expected = brute.closest_hits(rays);
                CHECK(missed(expected) == 0);
                for (const Tree& tree : trees) CHECK(count_different(hits_of(tree, rays), expected) == 0);
            }
        }
    }
}

TEST_CASE("watertight: the test of 1997 lets rays through, which shows that these rays can tell") {
    if (small_sizes()) return;
    const ClosedScene closed = make_closed(closed_kinds().front());
    const Tree tree = build(test_device(), closed.scene);
    const auto rays = rays_from_inside(closed, Aim::edges, 100000, 7);
    const TraceOptions old{.intersector = Intersector::moeller_trumbore};
    CHECK(missed(hits_of(tree, rays, old)) > 100);
    CHECK(missed(hits_of(tree, rays)) == 0);
}

TEST_CASE("watertight: a terrain grid seen from straight above") {
    // Spacings that are no powers of two, rays on corners of cells, on their edges and on their diagonals.
    const std::uint32_t side = small_sizes() ? 4 : 60;
    for (const float spacing : {1.0f / 3.0f, 0.1f, 0.7f}) {
        Mesh grid;
        Random random(71);
        for (std::uint32_t y = 0; y <= side; ++y)
            for (std::uint32_t x = 0; x <= side; ++x)
                grid.positions.emplace_back(spacing * static_cast<float>(x), random.uniform(0.0f, 0.2f),
                                            spacing * static_cast<float>(y));
        for (std::uint32_t y = 0; y < side; ++y)
            for (std::uint32_t x = 0; x < side; ++x) {
                const std::uint32_t i = y * (side + 1) + x;
                grid.triangles.emplace_back(i, i + 1, i + side + 1);
                grid.triangles.emplace_back(i + 1, i + side + 2, i + side + 1);
            }
        std::vector<Ray> rays;
        for (const glm::uvec3& t : grid.triangles)
            for (int k = 0; k < 3; ++k) {
                const glm::vec3 a = grid.positions[t[k]], b = grid.positions[t[(k + 1) % 3]];
                for (const glm::vec3& p : {a, 0.5f * (a + b), (a + b + grid.positions[t[(k + 2) % 3]]) / 3.0f})
                    rays.push_back({{p.x, 10.0f, p.z}, 0.0f, {0.0f, -1.0f, -0.0f}, 100.0f});
            }
        const Scene scene = single(grid);
        const std::vector<Hit> expected = BruteForce(scene, Levels::one).closest_hits(rays);
        CHECK(missed(expected) == 0);
        for (const Layout layout : {Layout::wide8, Layout::binary})
            CHECK(count_different(hits_of(build(test_device(), scene, {Levels::one, layout}), rays), expected) == 0);
    }
}

TEST_CASE("watertight: triangles whose corners are on one line are never hit") {
    // Corners a, a + k d, a + m d are exact for whole numbers; rays aimed at points between them.
    Random random(72);
    Mesh mesh;
    std::vector<Ray> rays;
    const auto whole = [&](int reach) { return static_cast<float>(static_cast<int>(random.below(2 * reach)) - reach); };
    for (std::uint32_t i = 0; i < (small_sizes() ? 8u : 2000u); ++i) {
        const glm::vec3 a(whole(1000), whole(1000), whole(1000)), d(whole(50), whole(50), whole(50));
        for (const float k : {0.0f, whole(20), whole(20)}) mesh.positions.push_back(a + k * d);
        mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
        const glm::vec3 target = glm::mix(mesh.positions[3 * i], mesh.positions[3 * i + 1], random.uniform(0, 1));
        const glm::vec3 origin(random.uniform(-900, 900), random.uniform(-900, 900), random.uniform(-900, 900));
        const glm::vec3 direction = target - origin;
        rays.push_back({{origin.x, origin.y, origin.z}, 0, {direction.x, direction.y, direction.z}, 10.0f});
    }
    const Scene scene = single(mesh);
    for (const Layout layout : {Layout::wide8, Layout::binary})
        CHECK(missed(hits_of(build(test_device(), scene, {Levels::one, layout}), rays)) == rays.size());
}

TEST_SUITE_END();
