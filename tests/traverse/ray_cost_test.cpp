// SPDX-License-Identifier: MIT
// What rays meet of a marked tree, against plain recursion in double precision and brute force.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "build/built_trees.hpp"
#include "layout/triangle_records.hpp"
#include "oracles/brute_force.hpp"
#include "oracles/reference_builder.hpp"
#include "traverse/ray_cost.hpp"
#include "traverse/scenes.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("traverse");

namespace {

/// A linear BVH whose subtrees of up to `leaf_size` primitives are leaves, on the device and on the host.
struct Marked {
    BuiltTrees built;
    SceneSphere sphere;
    std::vector<std::array<glm::vec3, 3>> corners;
    std::vector<std::uint32_t> leaves;
    Buffer<std::uint32_t> device_leaves;
    Buffer<Triangle> triangles;

    Marked(const Scene& scene, std::uint32_t leaf_size)
        : built(build_trees_of(test_device(), scene)), sphere(scene_sphere(scene)),
          corners(test::corners(scene.meshes[0])), leaves(built.topology.size()) {
        Device& device = test_device();
        const auto count = built.topology.size();
        for (std::uint32_t i = 0; i + 1 < count; ++i) {
            const Span span = span_of(built.topology, i);
            leaves[i] = span.last - span.first + 1 <= leaf_size ? 1 : 0;
        }
        device_leaves = upload(device, leaves, "leaves");
        triangles = triangle_records(device, built.trees.topology, built.geometry, {});
    }

    std::vector<RayVisits> visits(const std::vector<Ray>& rays, std::vector<Hit>& hits) const {
        Device& device = test_device();
        const Guarded<RayVisits> all(device, rays.size());
        const Guarded<Hit> all_hits(device, rays.size());
        ray_visits(device, {built.trees.topology, built.trees.volumes, device_leaves, triangles, sphere},
                   upload(device, rays, "rays"), all.view(), all_hits.view());
        CHECK(all.intact());
        CHECK(all_hits.intact());
        hits = all_hits.values();
        return all.values();
    }
};

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Where the ray enters the box widened by `slack` of its coordinates; infinity when it does not.
double entry(const Ray& ray, const Aabb& box, double limit, double slack) {
    double first = ray.t_min, last = limit;
    for (int k = 0; k < 3; ++k) {
        const double size =
            std::max({std::abs(double(box.min[k])), std::abs(double(box.max[k])), std::abs(double(ray.origin[k]))});
        const double low = box.min[k] - slack * size - ray.origin[k], high = box.max[k] + slack * size - ray.origin[k];
        if (ray.direction[k] == 0.0f) {
            if (low > 0.0 || high < 0.0) return infinity;
            continue;
        }
        const double a = low / ray.direction[k], b = high / ray.direction[k];
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
    }
    return first <= last ? first : infinity;
}

/// The oracle: the same two walks in plain recursion.
struct Reference {
    const Marked& tree;
    const Ray& ray;
    double slack;
    RayVisits visits{};
    double closest;

    Reference(const Marked& marked, const Ray& r, double s) : tree(marked), ray(r), slack(s), closest(r.t_max) {
        const std::uint32_t root = tree.built.topology.root(0);
        meet(root);
        if (entry(ray, tree.built.volumes[root], closest, slack) < infinity) search(root);
    }
    bool is_leaf(std::uint32_t node) const { return node >= tree.leaves.size() || tree.leaves[node]; }
    void meet(std::uint32_t node) {
        if (entry(ray, tree.built.volumes[node], ray.t_max, slack) == infinity) return;
        const Span span = span_of(tree.built.topology, node);
        if (is_leaf(node)) {
            visits.primitives += span.last - span.first + 1;
            return;
        }
        visits.nodes += 1;
        for (int side = 0; side < 2; ++side) meet(tree.built.topology.children[node].s[side]);
    }
    void search(std::uint32_t node) {
        const Span span = span_of(tree.built.topology, node);
        if (is_leaf(node)) {
            visits.primitives_to_hit += span.last - span.first + 1;
            for (std::uint32_t i = span.first; i <= span.last; ++i) {
                const auto hit = intersect_in_double(ray, tree.corners[tree.built.topology.order[i]]);
                if (hit && (*hit)[0] > ray.t_min) closest = std::min(closest, (*hit)[0]);
            }
            return;
        }
        visits.nodes_to_hit += 1;
        std::uint32_t near = tree.built.topology.children[node].s[0], far = tree.built.topology.children[node].s[1];
        double near_entry = entry(ray, tree.built.volumes[near], closest, slack);
        double far_entry = entry(ray, tree.built.volumes[far], closest, slack);
        if (far_entry < near_entry) {
            std::swap(near, far);
            std::swap(near_entry, far_entry);
        }
        if (near_entry < infinity) search(near);
        if (far_entry < infinity && far_entry <= closest) search(far);
    }
};

bool same(const RayVisits& a, const RayVisits& b) {
    return a.nodes == b.nodes && a.primitives == b.primitives && a.nodes_to_hit == b.nodes_to_hit &&
           a.primitives_to_hit == b.primitives_to_hit;
}

} // namespace

TEST_CASE("ray_cost: every count is that of plain recursion, hits are those of brute force") {
    // One and two primitives are a leaf or a root of leaves; the last makes stacks and slices.
    for (const std::uint32_t count : {1u, 2u, 3u, 64u, small_sizes() ? 65u : 3000u}) {
        for (const std::uint32_t leaf_size : {1u, 2u, 5u}) {
            CAPTURE(count);
            CAPTURE(leaf_size);
            Random random(count);
            const Scene scene = single(test::random_mesh(random, count, 0.4f));
            const Marked tree(scene, leaf_size);
            const std::vector<Ray> rays = random_rays(random, small_sizes() ? 60 : 3000, 2.0f);
            std::vector<Hit> hits;
            const std::vector<RayVisits> visits = tree.visits(rays, hits);
            CHECK(count_different(hits, BruteForce(scene, Levels::one).closest_hits(rays)) == 0);
            std::size_t wrong = 0, compared = 0;
            for (std::size_t i = 0; i < rays.size(); ++i) {
                // Where rounding may decide, that is where a little wider or narrower boxes give other counts, nothing
                // is said.
                const Reference wide(tree, rays[i], 1e-5), narrow(tree, rays[i], -1e-5);
                if (!same(wide.visits, narrow.visits)) continue;
                ++compared;
                if (!same(visits[i], wide.visits)) ++wrong;
            }
            CHECK(wrong == 0);
            CHECK(compared * 10 > rays.size() * 8);
        }
    }
}

TEST_CASE("ray_cost: a hit hides what is behind it from the search alone") {
    // Ten parallel squares' halves, one behind the other, met in their middle.
    Mesh mesh;
    for (int i = 0; i < 10; ++i) {
        const float z = static_cast<float>(i);
        for (const glm::vec3& p : {glm::vec3(-1, -1, z), glm::vec3(3, -1, z), glm::vec3(-1, 3, z)})
            mesh.positions.push_back(p);
        mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    const Marked tree(single(mesh), 1);
    std::vector<Hit> hits;
    const std::vector<Ray> rays{{{0, 0, -1}, 0, {0, 0, 1}, INFINITY},
                                {{0, 0, -1}, 0, {0, 0, -1}, INFINITY},
                                {{0, 0, -1}, 0, {0, 0, 0}, INFINITY}};
    const std::vector<RayVisits> visits = tree.visits(rays, hits);
    CHECK(visits[0].nodes == 9);
    CHECK(visits[0].primitives == 10);
    CHECK(visits[0].primitives_to_hit == 1);
    CHECK(visits[0].nodes_to_hit < 9);
    CHECK(hits[0].primitive == 0);
    CHECK(hits[0].t == 1.0f);
    for (int i = 1; i < 3; ++i) CHECK(same(visits[i], RayVisits{}));
}

TEST_CASE("ray_cost: no primitives, no visits") {
    Device& device = test_device();
    Topology topology;
    const Guarded<RayVisits> visits(device, 3);
    const Guarded<Hit> hits(device, 3);
    ray_visits(device, {topology, {}, {}, {}, {}}, upload(device, std::vector<Ray>(3), "rays"), visits.view(),
               hits.view());
    for (const RayVisits& each : visits.values()) CHECK(same(each, RayVisits{}));
    for (const Hit& hit : hits.values()) CHECK(hit.primitive == BOXWOOD_NONE);
}

TEST_SUITE_END();
