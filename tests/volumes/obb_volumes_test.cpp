// SPDX-License-Identifier: MIT
// Oriented boxes of trees at the extremes: every kind holds every primitive in every ancestor, checked in double
// precision.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "boxwood/obb.hpp"
#include "boxwood/procedural.hpp"
#include "boxwood/volumes.hpp"
#include "build/built_trees.hpp"
#include "oracles/extreme_meshes.hpp"
#include "tuning.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("volumes");

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
std::size_t count_outside(const BuiltTrees& built, const Scene& scene, const std::vector<Obb>& boxes) {
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

Sums sums_of(const std::vector<Aabb>& boxes) {
    Sums sums;
    for (const Aabb& box : boxes) {
        if (box.min[0] > box.max[0]) continue;
        const double x = double(box.max[0]) - box.min[0], y = double(box.max[1]) - box.min[1],
                     z = double(box.max[2]) - box.min[2];
        sums.volume += x * y * z;
        sums.area += 2.0 * (x * y + y * z + z * x);
        ++sums.nodes;
    }
    return sums;
}

std::vector<Obb> boxes_of(const BuiltTrees& built, const BoundsOptions& options) {
    Device& device = test_device();
    return download(device, obb_volumes(device, built.trees.topology, built.trees.volumes, built.geometry, options));
}

/// Boxes that are not orthonormal to rounding and right-handed, or whose extents are not finite.
std::size_t count_malformed(const std::vector<Obb>& boxes) {
    std::size_t malformed = 0;
    for (const Obb& box : boxes) {
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
    return malformed;
}

} // namespace

TEST_CASE("obb_volumes: at the extremes every kind holds every primitive in every ancestor") {
    // Sizes around those where code paths change: 1, 2, 3, a vector's 8 and 9, more than it takes for a node to be
    // refined (256), and to be cut in chunks (4096).
    std::vector<ExtremeMesh> extremes = extreme_meshes(small_sizes() ? 12 : 300, test_seed());
    for (const std::size_t count : {1, 2, 3, 8, 9})
        extremes.push_back({std::to_string(count) + " triangles", cube_of_triangles(count, count)});
    extremes.push_back({"turned cube, 2 triangles a face", turned_cube(1)});
    if (!small_sizes()) {
        extremes.push_back({"600 triangles", cube_of_triangles(600, 600)});
        for (ExtremeMesh& extreme : extreme_meshes(5000, test_seed()))
            if (extreme.words == "ordinary" || extreme.words == "equal Morton codes") extremes.push_back(extreme);
    }
    for (const ExtremeMesh& extreme : extremes) {
        CAPTURE(extreme.words);
        const Scene scene = scene_of({extreme.mesh});
        const BuiltTrees built = build_trees_of(test_device(), scene);
        const Sums control = sums_of(built.volumes);
        for (Variant& variant : variants()) {
            for (const Measure measure : {Measure::volume, Measure::area}) {
                CAPTURE(variant.words);
                variant.options.measure = measure;
                const std::vector<Obb> boxes = boxes_of(built, variant.options);
                CHECK(count_outside(built, scene, boxes) == 0);
                CHECK(count_malformed(boxes) == 0);
                // With the fallback no kind is larger than the AABBs, but for their rounding outward (denormals aside,
                // where that is as large as they are).
                if (extreme.words == "denormals") continue;
                const Sums sums = sums_of(boxes);
                if (measure == Measure::volume && control.volume > 0.0)
                    CHECK(sums.volume <= control.volume * (1.0 + 1e-5));
                if (measure == Measure::area && control.area > 0.0) CHECK(sums.area <= control.area * (1.0 + 1e-5));
            }
        }
    }
}

TEST_CASE("obb_volumes: without the fallback no node keeps its AABB, and all is still contained") {
    const Scene scene =
        scene_of({cube_of_triangles(small_sizes() ? 60 : 600, 20), turned_cube(4), cube_of_triangles(1, 21)});
    const BuiltTrees built = build_trees_of(test_device(), scene);
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
    const Scene scene = scene_of({cube_of_triangles(small_sizes() ? 530 : 6000, 30), cube_of_triangles(1, 31),
                                  cube_of_triangles(2, 32), turned_cube(small_sizes() ? 1 : 12)});
    const BuiltTrees built = build_trees_of(test_device(), scene);
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
    const Mesh mesh = cube_of_triangles(small_sizes() ? 20 : 700, 40);
    const BuiltTrees plain = build_trees_of(test_device(), scene_of({mesh}));
    for (const Variant& variant : variants()) {
        CAPTURE(variant.words);
        const std::vector<Obb> expected = boxes_of(plain, variant.options);
        for (const int k : {-40, -13, 1, 40}) {
            CAPTURE(k);
            Mesh scaled = mesh;
            for (glm::vec3& p : scaled.positions) p *= std::ldexp(1.0f, k);
            const BuiltTrees built = build_trees_of(test_device(), scene_of({scaled}));
            CHECK(difference(built.topology, plain.topology).empty());
            const std::vector<Obb> boxes = boxes_of(built, variant.options);
            std::size_t different = 0;
            for (std::size_t i = 0; i < boxes.size(); ++i) {
                bool same = boxes[i].aligned == expected[i].aligned &&
                            std::equal(boxes[i].axes, boxes[i].axes + 9, expected[i].axes);
                for (int axis = 0; axis < 3; ++axis)
                    same = same && boxes[i].extent[axis] == std::ldexp(expected[i].extent[axis], k) &&
                           boxes[i].center[axis] == std::ldexp(expected[i].center[axis], k);
                if (!same) ++different;
            }
            CHECK(different == 0);
        }
    }
}

TEST_CASE("obb_volumes: turning a scene hardly changes the boxes of its points") {
    const Mesh mesh = make_procedural("terrain", {.triangles = small_sizes() ? 50u : 20000u}).meshes[0];
    const glm::dmat3 turn(0.36, 0.48, -0.8, -0.8, 0.6, 0.0, 0.48, 0.64, 0.6);
    Mesh turned = mesh;
    for (glm::vec3& p : turned.positions) p = glm::vec3(turn * glm::dvec3(p));
    // A linear BVH of the turned mesh has other nodes: only over one topology can the boxes be compared.
    Device& device = test_device();
    const BuiltTrees built = build_trees_of(device, scene_of({mesh}));
    const Geometry geometry = upload(device, scene_of({turned}));
    std::vector<Aabb> triangles;
    for (const glm::uvec3& triangle : turned.triangles) triangles.push_back(box_of(turned, triangle));
    const Buffer<Aabb> aabbs = aabb_volumes(device, built.trees.topology, upload(device, triangles, "boxes"));
    const double aligned = sums_of(built.volumes).volume, aligned_turned = sums_of(download(device, aabbs)).volume;
    for (const Bounds kind : {Bounds::obb_points, Bounds::obb_moments, Bounds::obb_refined}) {
        CAPTURE(name(kind));
        const BoundsOptions options{.kind = kind, .fallback = false};
        const double before = sums_of(boxes_of(built, options)).volume;
        const double after =
            sums_of(download(device, obb_volumes(device, built.trees.topology, aabbs, geometry, options))).volume;
        MESSAGE(name(kind) << " " << before << " to " << after << ", AABBs " << aligned << " to " << aligned_turned);
        CHECK(std::fabs(after - before) < 0.05 * before);
        CHECK(aligned_turned > 1.5 * aligned);
    }
}

TEST_CASE("obb_volumes: exact moments are points, points are below boxes") {
    // The orders of the dissertation's table 4, on a curved surface.
    if (small_sizes()) {
        MESSAGE("skipped: a surface too large for a checker");
        return;
    }
    const Scene scene = make_procedural("sphere", {.triangles = 20000});
    const BuiltTrees built = build_trees_of(test_device(), scene);
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
