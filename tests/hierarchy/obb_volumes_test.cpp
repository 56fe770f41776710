// SPDX-License-Identifier: MIT
// Oriented boxes of trees at the extremes: every kind holds every primitive in every ancestor, checked in double precision.
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "boxwood/build.hpp"
#include "boxwood/gltf.hpp"
#include "boxwood/lbvh.hpp"
#include "boxwood/obb.hpp"
#include "boxwood/procedural.hpp"
#include "boxwood/volumes.hpp"
#include "hierarchy/forest_scene.hpp"
#include "tuning.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("hierarchy");

namespace {

struct Variant {
    BoundsOptions options;
    std::string words;
};

/// Every kind of oriented box, with both kinds of extents where there is a choice.
std::vector<Variant> variants() {
    std::vector<Variant> all;
    for (const Bounds kind : all_bounds()) {
        if (kind == Bounds::aabb) continue;
        all.push_back({{.kind = kind}, std::string(name(kind))});
        if (kind == Bounds::obb_moments) {
            all.push_back({{.kind = kind, .extents = Extents::corners}, "obb-moments (corners)"});
        }
    }
    return all;
}

/// Primitives that stick out of an ancestor's box. A NaN anywhere counts as outside.
std::size_t count_outside(const BuiltForest& built, const Scene& scene, const std::vector<Obb>& boxes) {
    const HostTopology& t = built.topology;
    std::size_t outside = 0;
    for (std::uint32_t i = 0; i < t.size(); ++i) {
        const std::uint32_t primitive = t.order[i];
        const auto tree = std::upper_bound(t.offsets.begin(), t.offsets.end(), primitive) - t.offsets.begin() - 1;
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(tree)];
        const glm::uvec3 corners = mesh.triangles[primitive - t.offsets[static_cast<std::size_t>(tree)]];
        for (std::uint32_t node = t.size() + i; node != BOXWOOD_NONE; node = t.parents[node])
            for (int k = 0; k < 3; ++k)
                if (!contains(boxes[node], glm::dvec3(mesh.positions[corners[k]]))) ++outside;
    }
    return outside;
}

struct Sums {
    double volume = 0.0, area = 0.0;
    std::size_t oriented = 0, nodes = 0;
};

Sums sums_of(const std::vector<Obb>& boxes) {
    Sums sums;
    for (const Obb& box : boxes) {
        if (box.extent[0] < 0.0f) continue;
        sums.volume += volume(box);
        sums.area += surface_area(box);
        sums.oriented += box.aligned ? 0 : 1;
        ++sums.nodes;
    }
    return sums;
}

double aabb_volume(const std::vector<Aabb>& boxes) {
    double sum = 0.0;
    for (const Aabb& box : boxes)
        if (box.min[0] <= box.max[0])
            sum += (double(box.max[0]) - box.min[0]) * (double(box.max[1]) - box.min[1]) *
                   (double(box.max[2]) - box.min[2]);
    return sum;
}

std::vector<Obb> boxes_of(const BuiltForest& built, const BoundsOptions& options) {
    Device& device = test_device();
    return download(device, obb_volumes(device, built.forest.topology, built.forest.volumes, built.geometry, options));
}

/// Orthonormal to rounding and right-handed, extents finite and not negative, and no larger than the AABB it replaced.
std::size_t count_malformed(const BuiltForest& built, const std::vector<Obb>& boxes) {
    std::size_t malformed = 0;
    for (std::uint32_t node = 0; node < boxes.size(); ++node) {
        const Obb& box = boxes[node];
        if (box.extent[0] < 0.0f) continue; // unused
        const glm::dmat3 rows(box.axes[0], box.axes[1], box.axes[2], box.axes[3], box.axes[4], box.axes[5], box.axes[6],
                              box.axes[7], box.axes[8]);
        const glm::dmat3 product = glm::transpose(rows) * rows;
        bool good = glm::determinant(rows) > 0.99;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) good = good && std::fabs(product[i][j] - (i == j)) < 24 * 0x1p-24;
        for (int k = 0; k < 3; ++k)
            good = good && std::isfinite(box.center[k]) && std::isfinite(box.extent[k]) && box.extent[k] >= 0.0f;
        if (!good) ++malformed;
    }
    (void)built;
    return malformed;
}

Mesh triangles_of(const std::vector<glm::vec3>& corners) {
    Mesh mesh;
    mesh.positions = corners;
    for (std::uint32_t i = 0; i + 2 < corners.size(); i += 3) mesh.triangles.push_back({i, i + 1, i + 2});
    return mesh;
}

/// Random triangles whose corners `place` puts somewhere.
Mesh placed(std::size_t triangles, std::uint64_t salt, const std::function<glm::vec3(Random&)>& place) {
    Random random(salt);
    std::vector<glm::vec3> corners;
    for (std::size_t i = 0; i < 3 * triangles; ++i) corners.push_back(place(random));
    return triangles_of(corners);
}

glm::vec3 in_cube(Random& random) {
    return {random.uniform(-1.0f, 1.0f), random.uniform(-1.0f, 1.0f), random.uniform(-1.0f, 1.0f)};
}

/// A cube of half size 50 turned by some angle about an oblique axis, n x n squares per face.
Mesh turned_cube(std::uint32_t n) {
    const glm::dvec3 a(0.36, 0.48, -0.8), b(-0.8, 0.6, 0.0), c = glm::cross(a, b);
    std::vector<glm::vec3> corners;
    const auto at = [&](int axis, double side, double u, double v) {
        glm::dvec3 p;
        p[axis] = side;
        p[(axis + 1) % 3] = u;
        p[(axis + 2) % 3] = v;
        return glm::vec3(50.0 * (p.x * a + p.y * b + p.z * c));
    };
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0})
            for (std::uint32_t i = 0; i < n; ++i)
                for (std::uint32_t j = 0; j < n; ++j) {
                    const double u = 2.0 * i / n - 1, v = 2.0 * j / n - 1, s = 2.0 / n;
                    const glm::vec3 p = at(axis, side, u, v), q = at(axis, side, u + s, v),
                                    r = at(axis, side, u + s, v + s), t = at(axis, side, u, v + s);
                    corners.insert(corners.end(), {p, q, r, p, r, t});
                }
    return triangles_of(corners);
}

struct Extreme {
    std::string words;
    Mesh mesh;
};

/// The extremes: sizes around those where code paths change are 1, 2, 3, a vector's 8 and 9, and more than a node needs to
/// be refined (512) or to be cut in chunks (4096).
std::vector<Extreme> extremes() {
    const std::size_t many = small_sizes() ? 600 : 5000;
    const glm::vec3 along(1.0f, 0.7f, -0.3f), across(0.2f, -0.5f, 0.9f);
    std::vector<Extreme> list;
    for (const std::size_t count : {1, 2, 3, 8, 9, 600})
        list.push_back({std::to_string(count) + " triangles", placed(count, count, in_cube)});
    list.push_back({"many triangles", placed(many, 1, in_cube)});
    list.push_back({"one point", placed(300, 2, [](Random&) { return glm::vec3(3, -5, 7); })});
    list.push_back({"one point at the origin", placed(10, 2, [](Random&) { return glm::vec3(0); })});
    list.push_back({"collinear", placed(300, 3, [&](Random& r) { return r.uniform(-1, 1) * along; })});
    list.push_back(
        {"coplanar", placed(300, 4, [&](Random& r) { return r.uniform(-1, 1) * along + r.uniform(-1, 1) * across; })});
    list.push_back(
        {"needles 1e6:1", placed(300, 5, [&](Random& r) { return r.uniform(-1, 1) * along + 1e-6f * in_cube(r); })});
    list.push_back({"1e-30", placed(300, 6, [](Random& r) { return 1e-30f * in_cube(r); })});
    list.push_back({"1e18", placed(300, 7, [](Random& r) { return 1e18f * in_cube(r); })});
    list.push_back({"features of 1e-3 at 1e7",
                    placed(300, 8, [](Random& r) { return glm::vec3(1e7f, -1e7f, 1e7f) + 1e-3f * in_cube(r); })});
    list.push_back({"features of 1e-3 at 1e3",
                    placed(300, 8, [](Random& r) { return glm::vec3(1e3f, -1e3f, 1e3f) + 1e-3f * in_cube(r); })});
    list.push_back({"denormals", placed(300, 9, [](Random& r) { return 1e-41f * in_cube(r); })});
    list.push_back({"sizes from 1e-38 to 1e18", placed(300, 10, [](Random& r) {
                        return std::ldexp(1.0f, static_cast<int>(r.below(186)) - 126) * in_cube(r);
                    })});
    list.push_back(
        {"equal Morton codes", placed(many, 11, [](Random& r) { return glm::vec3(1.0f) + 1e-6f * in_cube(r); })});
    list.back().mesh.triangles.push_back({0, 1, 2});
    list.back().mesh.positions.push_back({-1e3f, -1e3f, -1e3f});
    list.back().mesh.triangles.back().z = static_cast<std::uint32_t>(list.back().mesh.positions.size() - 1);
    list.push_back({"turned cube", turned_cube(1)});
    list.push_back({"turned cube, 16 x 16", turned_cube(16)});
    list.push_back({"covariance diag(2000, 1, 0)",
                    placed(300, 12, [](Random& r) { return glm::vec3(44.7f, 1.0f, 0.0f) * in_cube(r); })});
    return list;
}

} // namespace

TEST_CASE("obb_volumes: at the extremes every kind holds every primitive in every ancestor") {
    for (const Extreme& extreme : extremes()) {
        CAPTURE(extreme.words);
        const Scene scene = scene_of({extreme.mesh});
        const BuiltForest built = build_forest_of(test_device(), scene);
        const double control = aabb_volume(built.volumes);
        for (Variant& variant : variants()) {
            for (const Measure measure : {Measure::volume, Measure::area}) {
                CAPTURE(variant.words);
                variant.options.measure = measure;
                const std::vector<Obb> boxes = boxes_of(built, variant.options);
                CHECK(count_outside(built, scene, boxes) == 0);
                CHECK(count_malformed(built, boxes) == 0);
                // With the fallback no kind is larger than the AABBs, but for their rounding outward (denormals aside,
                // where that is as large as they are).
                if (measure == Measure::volume && extreme.words != "denormals" && control > 0.0)
                    CHECK(sums_of(boxes).volume <= control * (1.0 + 1e-5));
            }
        }
    }
}

TEST_CASE("obb_volumes: without the fallback no node keeps its AABB, and all is still contained") {
    const Scene scene = scene_of({placed(600, 20, in_cube), turned_cube(4), placed(1, 21, in_cube)});
    const BuiltForest built = build_forest_of(test_device(), scene);
    for (Variant& variant : variants()) {
        CAPTURE(variant.words);
        variant.options.fallback = false;
        const std::vector<Obb> boxes = boxes_of(built, variant.options);
        CHECK(count_outside(built, scene, boxes) == 0);
        CHECK(sums_of(boxes).oriented == sums_of(boxes).nodes);
        CHECK(sums_of(boxes).nodes == 2 * built.topology.size() - built.topology.trees());
    }
}

TEST_CASE("obb_volumes: every tuning gives the same bytes") {
    const Scene scene = scene_of({placed(small_sizes() ? 700 : 6000, 30, in_cube), placed(1, 31, in_cube),
                                  placed(2, 32, in_cube), turned_cube(small_sizes() ? 3 : 12)});
    const BuiltForest built = build_forest_of(test_device(), scene);
    for (const Variant& variant : variants()) {
        CAPTURE(variant.words);
        const std::vector<Obb> expected = boxes_of(built, variant.options);
        for (const Tuning& tuning : tunings()) {
            CAPTURE(tuning.group_size);
            const TuningScope scope(tuning);
            CHECK(same_bits(boxes_of(built, variant.options), expected));
        }
    }
}

TEST_CASE("obb_volumes: a scene times 2^k has the same topology and the same axes, bit for bit") {
    const Mesh mesh = placed(700, 40, in_cube);
    const BuiltForest plain = build_forest_of(test_device(), scene_of({mesh}));
    for (const Variant& variant : variants()) {
        CAPTURE(variant.words);
        const std::vector<Obb> expected = boxes_of(plain, variant.options);
        for (const int k : {-40, -13, 1, 40}) {
            CAPTURE(k);
            Mesh scaled = mesh;
            for (glm::vec3& p : scaled.positions) p *= std::ldexp(1.0f, k);
            const BuiltForest built = build_forest_of(test_device(), scene_of({scaled}));
            CHECK(difference(built.topology, plain.topology).empty());
            const std::vector<Obb> boxes = boxes_of(built, variant.options);
            std::size_t different = 0;
            for (std::size_t i = 0; i < boxes.size(); ++i) {
                bool same = boxes[i].aligned == expected[i].aligned &&
                            std::equal(boxes[i].axes, boxes[i].axes + 9, expected[i].axes);
                for (int axis = 0; axis < 3; ++axis)
                    same = same && boxes[i].extent[axis] == std::ldexp(expected[i].extent[axis], k);
                if (!same) ++different;
            }
            CHECK(different == 0);
        }
    }
}

TEST_CASE("obb_volumes: turning a scene hardly changes the boxes of its points") {
    const Mesh mesh = make_procedural("terrain", {.triangles = small_sizes() ? 500u : 20000u}).meshes[0];
    const glm::dmat3 turn(0.36, 0.48, -0.8, -0.8, 0.6, 0.0, 0.48, 0.64, 0.6);
    Mesh turned = mesh;
    for (glm::vec3& p : turned.positions) p = glm::vec3(turn * glm::dvec3(p));
    // A linear BVH of the turned mesh has other nodes: only over one topology can the boxes be compared.
    Device& device = test_device();
    const BuiltForest built = build_forest_of(device, scene_of({mesh}));
    const Geometry geometry = upload(device, scene_of({turned}));
    std::vector<Aabb> triangles;
    for (const glm::uvec3& triangle : turned.triangles) triangles.push_back(box_of(turned, triangle));
    const Buffer<Aabb> aabbs = aabb_volumes(device, built.forest.topology, upload(device, triangles, "boxes"));
    const double aligned = aabb_volume(built.volumes), aligned_turned = aabb_volume(download(device, aabbs));
    for (const Bounds kind : {Bounds::obb_points, Bounds::obb_moments, Bounds::obb_refined}) {
        CAPTURE(name(kind));
        const BoundsOptions options{.kind = kind, .fallback = false};
        const double before = sums_of(boxes_of(built, options)).volume;
        const double after =
            sums_of(download(device, obb_volumes(device, built.forest.topology, aabbs, geometry, options))).volume;
        MESSAGE(name(kind) << " " << before << " to " << after << ", AABBs " << aligned << " to " << aligned_turned);
        CHECK(std::fabs(after - before) < 0.05 * before);
        CHECK(aligned_turned > 1.5 * aligned);
    }
}

TEST_CASE("obb_volumes: exact moments are points, points are below boxes") {
    // The orders of the dissertation's table 4, on a curved surface.
    const Scene scene = make_procedural("sphere", {.triangles = 20000});
    const BuiltForest built = build_forest_of(test_device(), scene);
    const auto of = [&](Bounds kind, Extents extents = Extents::exact) {
        return sums_of(boxes_of(built, {.kind = kind, .extents = extents})).volume;
    };
    const double points = of(Bounds::obb_points), moments = of(Bounds::obb_moments);
    CHECK(std::fabs(moments - points) <= 0.01 * points);
    CHECK(points < of(Bounds::obb_boxes));
    CHECK(points < of(Bounds::obb_quaternion));
    CHECK(of(Bounds::obb_refined) < points);
    CHECK(of(Bounds::obb_moments, Extents::corners) < of(Bounds::obb_boxes));
}
