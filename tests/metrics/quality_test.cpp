// SPDX-License-Identifier: MIT
// Metrics of forests with oriented boxes, and the end-point overlap, against double precision on the host.
#include "metrics/quality.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>

#include "boxwood/collapse.hpp"
#include "build/built_trees.hpp"
#include "metrics/overlap.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("metrics");

namespace {

constexpr double tolerance = 1e-5; // sums of a few thousand floats, pairwise

/// Boxes of any orientation and shape about the middle of each node's AABB, some `flat`, every third as the AABB.
std::vector<Obb> random_boxes(const std::vector<Aabb>& volumes, bool sheared, bool flat) {
    Random random(11);
    std::vector<Obb> boxes;
    for (std::size_t i = 0; i < volumes.size(); ++i) {
        const Aabb& box = volumes[i];
        Obb obb{};
        obb.aligned = i % 3 == 0 ? 1 : 0;
        for (int k = 0; k < 9; ++k) obb.axes[k] = k % 4 == 0 ? 1.0f : 0.0f;
        for (int k = 0; k < 3; ++k) {
            obb.center[k] = 0.5f * (box.min[k] + box.max[k]);
            obb.extent[k] = 0.5f * (box.max[k] - box.min[k]) * (obb.aligned ? 1.0f : random.uniform(0.5f, 1.0f));
        }
        if (flat && !obb.aligned && i % 7 == 1) obb.extent[i % 3] = 0.0f;
        if (!(box.min[0] <= box.max[0])) obb.extent[0] = obb.extent[1] = obb.extent[2] = -INFINITY;
        const float angle = random.uniform(0.0f, 3.0f), c = std::cos(angle), s = std::sin(angle);
        if (!obb.aligned) {
            const float shear = sheared ? random.uniform(-1.0f, 1.0f) : 0.0f, size = sheared ? 1000.0f : 1.0f;
            const float rows[9] = {size * c, size * s, size * shear, -s, c, 0.0f, 0.0f, 0.0f, 1.0f};
            std::copy(rows, rows + 9, obb.axes);
            obb.extent[0] *= size;
        }
        boxes.push_back(obb);
    }
    return boxes;
}

/// The edges of a box: the columns of the inverse of its axes, as long as the box.
glm::dmat3 edges_of(const Obb& box) {
    glm::dmat3 rows;
    for (int k = 0; k < 9; ++k) rows[k % 3][k / 3] = box.axes[k];
    glm::dmat3 edges = glm::inverse(rows);
    for (int k = 0; k < 3; ++k) edges[k] *= 2.0 * box.extent[k];
    return edges;
}

double area_of_edges(const glm::dmat3& e) {
    return 2.0 * (glm::length(glm::cross(e[0], e[1])) + glm::length(glm::cross(e[1], e[2])) +
                  glm::length(glm::cross(e[2], e[0])));
}

glm::dmat3 edges_of(const Aabb& box) {
    glm::dmat3 edges(0.0);
    for (int k = 0; k < 3; ++k) edges[k][k] = double(box.max[k]) - box.min[k];
    return edges;
}

Scene three_meshes(float scale = 1.0f) {
    Scene scene =
        scene_of({random_mesh(300, 1.0f, 0.2f, 1), random_mesh(1, 1.0f, 1.0f, 2), random_mesh(70, 2.0f, 0.5f, 3)});
    for (Mesh& mesh : scene.meshes)
        for (glm::vec3& position : mesh.positions) position *= scale;
    return scene;
}

BuiltTrees oriented_trees(const Scene& scene, bool sheared, bool flat) {
    BuiltTrees built = build_trees_of(test_device(), scene);
    built.trees.boxes = upload(test_device(), random_boxes(built.volumes, sheared, flat), "boxes");
    return built;
}

/// What a node's box is, in the sense of the metrics.
struct HostBox {
    glm::dmat3 edges;
    glm::dvec3 center;
    bool fitted;
};

std::vector<HostBox> host_boxes(const BuiltTrees& built) {
    std::vector<Obb> boxes;
    if (built.trees.boxes.size() > 0) boxes = download(test_device(), built.trees.boxes);
    std::vector<HostBox> result;
    for (std::size_t i = 0; i < built.volumes.size(); ++i) {
        const Aabb& box = built.volumes[i];
        HostBox host{edges_of(box), {}, !boxes.empty() && boxes[i].aligned == 0};
        for (int k = 0; k < 3; ++k)
            host.center[k] = host.fitted ? boxes[i].center[k] : 0.5 * (double(box.min[k]) + box.max[k]);
        if (host.fitted) host.edges = edges_of(boxes[i]);
        result.push_back(host);
    }
    return result;
}

/// Visits every node below and with `node`.
void for_nodes(const HostTopology& topology, std::uint32_t node, const std::function<bool(std::uint32_t)>& visit) {
    if (!visit(node) || node >= topology.size()) return;
    for_nodes(topology, topology.children[node].s[0], visit);
    for_nodes(topology, topology.children[node].s[1], visit);
}

using Polygon = std::vector<glm::dvec3>;

double area_of(const Polygon& polygon) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 2; i < polygon.size(); ++i)
        sum += glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
    return 0.5 * glm::length(sum);
}

/// The part of `polygon` in the half-space normal . p <= offset, by Sutherland and Hodgman in space.
Polygon clipped(const Polygon& polygon, const glm::dvec3& normal, double offset) {
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        const double at_a = glm::dot(normal, a) - offset, at_b = glm::dot(normal, b) - offset;
        if (at_a <= 0.0) kept.push_back(a);
        if ((at_a <= 0.0) != (at_b <= 0.0)) kept.push_back(a + at_a / (at_a - at_b) * (b - a));
    }
    return kept;
}

Polygon clipped(Polygon polygon, const HostBox& box) {
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 normal = glm::normalize(glm::cross(box.edges[(k + 1) % 3], box.edges[(k + 2) % 3]));
        const double half = 0.5 * std::abs(glm::dot(normal, box.edges[k]));
        polygon = clipped(polygon, normal, glm::dot(normal, box.center) + half);
        polygon = clipped(polygon, -normal, -glm::dot(normal, box.center) + half);
    }
    return polygon;
}

double brute_force_overlap(const BuiltTrees& built, const std::vector<Triangle>& triangles, std::uint32_t stride = 1) {
    const std::vector<HostBox> boxes = host_boxes(built);
    double inside = 0.0, total = 0.0;
    for (std::uint32_t tree = 0; tree < built.topology.trees(); ++tree) {
        for (std::uint32_t p = built.topology.offsets[tree]; p < built.topology.offsets[tree + 1]; p += stride) {
            const Triangle& t = triangles[p];
            const glm::dvec3 v0(t.v0[0], t.v0[1], t.v0[2]);
            const Polygon polygon{v0, glm::dvec3(t.v1[0], t.v1[1], t.v1[2]), glm::dvec3(t.v2[0], t.v2[1], t.v2[2])};
            total += area_of(polygon);
            for_nodes(built.topology, built.topology.root(tree), [&](std::uint32_t node) {
                const Span span = span_of(built.topology, node);
                if (span.first <= p && p <= span.last) return true;
                const Polygon part = clipped(polygon, boxes[node]);
                inside += area_of(part);
                return !part.empty();
            });
        }
    }
    return total > 0.0 ? inside / total : 0.0;
}

/// The end-point overlap of the device, and the triangles that it saw.
double device_overlap(const BuiltTrees& built, std::vector<Triangle>* triangles = nullptr) {
    const BinaryLayout layout =
        collapse_binary(test_device(), built.trees.topology, built.trees.volumes, &built.geometry);
    if (triangles) *triangles = download(test_device(), layout.leaves);
    return end_point_overlap(test_device(), built.trees, layout.leaves);
}

} // namespace

TEST_CASE("quality: sums over oriented boxes equal sums in double, sheared or not") {
    for (const bool sheared : {false, true}) {
        CAPTURE(sheared);
        const BuiltTrees built = oriented_trees(three_meshes(), sheared, true);
        const TreeQuality quality = measure(test_device(), built.trees, true);
        const std::vector<HostBox> boxes = host_boxes(built);
        double area = 0.0, volume = 0.0, fitted = 0.0, nodes = 0.0;
        for (std::uint32_t tree = 0; tree < 3; ++tree) {
            double tree_area = 0.0, inner_area = 0.0;
            for_nodes(built.topology, built.topology.root(tree), [&](std::uint32_t node) {
                tree_area += area_of_edges(boxes[node].edges);
                if (node < built.topology.size()) inner_area += area_of_edges(boxes[node].edges);
                volume += std::abs(glm::determinant(boxes[node].edges));
                fitted += boxes[node].fitted ? 1.0 : 0.0;
                nodes += 1.0;
                return true;
            });
            const double root = area_of_edges(boxes[built.topology.root(tree)].edges);
            CHECK(quality.root_area[tree] == doctest::Approx(root).epsilon(tolerance));
            CHECK(quality.sah[tree] == doctest::Approx(tree_area / root).epsilon(tolerance));
            CHECK(quality.inner_sah[tree] == doctest::Approx(inner_area / root).epsilon(tolerance));
            area += tree_area;
        }
        CHECK(quality.nodes == 599 + 1 + 139);
        CHECK(nodes == 599 + 1 + 139);
        CHECK(quality.sums.sum_area == doctest::Approx(area).epsilon(tolerance));
        CHECK(quality.sums.sum_volume == doctest::Approx(volume).epsilon(tolerance));
        CHECK(quality.sums.obb_smaller_fraction == doctest::Approx(fitted / nodes).epsilon(1e-12));
        REQUIRE(quality.leaf_area.size() == 371);
        for (std::uint32_t position = 0; position < 371; ++position)
            CHECK(quality.leaf_area[built.topology.order[position]] ==
                  doctest::Approx(area_of_edges(boxes[371 + position].edges)).epsilon(tolerance));
    }
}

TEST_CASE("quality: boxes that are all their node's AABB measure exactly as AABBs do") {
    BuiltTrees built = build_trees_of(test_device(), three_meshes());
    const TreeQuality aabb = measure(test_device(), built.trees);
    CHECK(aabb.sums.obb_smaller_fraction == 0.0);
    std::vector<Obb> boxes = random_boxes(built.volumes, false, false);
    for (Obb& box : boxes) box.aligned = 1; // the fitted boxes are then of no account
    built.trees.boxes = upload(test_device(), boxes, "boxes");
    const TreeQuality oriented = measure(test_device(), built.trees);
    CHECK(oriented.sums.sum_area == aabb.sums.sum_area);
    CHECK(oriented.sums.sum_volume == aabb.sums.sum_volume);
    CHECK(oriented.sah == aabb.sah);
    CHECK(oriented.sums.obb_smaller_fraction == 0.0);
}

TEST_CASE("quality: a scene times a power of two has its sums times powers of it, bit for bit") {
    const BuiltTrees plain = oriented_trees(three_meshes(), true, true);
    const TreeQuality reference = measure(test_device(), plain.trees);
    const double overlap = device_overlap(plain);
    for (const int k : {-40, 40}) { // squares and cubes of these leave float
        CAPTURE(k);
        const BuiltTrees built = oriented_trees(three_meshes(std::ldexp(1.0f, k)), true, true);
        const TreeQuality quality = measure(test_device(), built.trees);
        CHECK(quality.sums.sum_area == std::ldexp(reference.sums.sum_area, 2 * k));
        CHECK(quality.sums.sum_volume == std::ldexp(reference.sums.sum_volume, 3 * k));
        CHECK(quality.sah == reference.sah);
        CHECK(device_overlap(built) == overlap);
    }
}

// Without flat boxes: whether a triangle that crosses one meets it is then rounding alone, and boxes below do not nest.
TEST_CASE("quality: overlap: equals clipping every triangle against every node in double") {
    for (const bool oriented : {false, true}) {
        CAPTURE(oriented);
        const BuiltTrees built =
            oriented ? oriented_trees(three_meshes(), true, false) : build_trees_of(test_device(), three_meshes());
        std::vector<Triangle> triangles;
        const double overlap = device_overlap(built, &triangles);
        CHECK(overlap == doctest::Approx(brute_force_overlap(built, triangles)).epsilon(1e-4));
        CHECK(overlap > 0.5);
    }
}

TEST_CASE("quality: overlap: small cases that are known") {
    const auto overlap_of = [](const Mesh& mesh) {
        return device_overlap(build_trees_of(test_device(), scene_of({mesh})));
    };
    const Mesh one{"", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    CHECK(overlap_of(one) == 0.0);
    Mesh apart = one;
    for (const glm::vec3& p : one.positions) apart.positions.push_back(p + glm::vec3(5, 0, 0));
    apart.triangles.push_back({3, 4, 5});
    CHECK(overlap_of(apart) == 0.0);
    Mesh twice = one;
    twice.triangles.push_back({0, 1, 2}); // in its own leaf and in the other's
    CHECK(overlap_of(twice) == 1.0);
    Mesh square = one; // each half lies in the other's flat box
    square.positions.push_back({1, 1, 0});
    square.triangles.push_back({1, 3, 2});
    CHECK(overlap_of(square) == 1.0);
    Mesh point{"", {{1, 2, 3}}, {{0, 0, 0}, {0, 0, 0}}}; // no area
    CHECK(overlap_of(point) == 0.0);
}

TEST_CASE("quality: overlap: more triangles than samples, and triangles that all lie on each other") {
    if (small_sizes()) return;
    // Just above the largest number of samples: every position but a few is one, so the oracle's sparser sample differs
    // from it by chance alone; 5 % is four times the deviation seen between seeds.
    const BuiltTrees built =
        build_trees_of(test_device(), scene_of({random_mesh(overlap_samples + 5000, 1.0f, 0.02f, 4)}));
    std::vector<Triangle> triangles;
    const double overlap = device_overlap(built, &triangles);
    CHECK(overlap == doctest::Approx(brute_force_overlap(built, triangles, 16)).epsilon(0.05));
    // Each triangle lies in all nodes but its ancestors, so all visits to all nodes pass the limit many times.
    const std::uint32_t count = 100'000;
    Mesh same{"", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}};
    same.triangles.assign(count, glm::uvec3(0, 1, 2));
    const double nodes = device_overlap(build_trees_of(test_device(), scene_of({same})));
    CHECK(nodes < 2.0 * count);
    CHECK(nodes > 2.0 * count - 64.0); // no path is longer than the bits of a position and a code
}

TEST_SUITE_END();
