// SPDX-License-Identifier: MIT
// boxwood-benchmark-extremes: what meshes at the extremes of shape and of float cost the kinds of bounding volumes
// against an ordinary mesh of as many triangles, and how far the boxes are from exact ones. Alternating runs, medians.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "benchmark.hpp"
#include "boxwood/geometry.hpp"
#include "boxwood/volumes.hpp"
#include "build/trees.hpp"
#include "common/median.hpp"
#include "oracles/extreme_meshes.hpp"
#include "oracles/triangle_box.hpp"

namespace boxwood {
namespace {

constexpr std::size_t triangles = 20000;

struct Case {
    test::ExtremeMesh extreme;
    Geometry geometry;
    BinaryTrees trees;
};

/// Every kind but the control.
std::vector<Bounds> oriented_kinds() {
    std::vector<Bounds> kinds = all_bounds();
    std::erase(kinds, Bounds::aabb);
    return kinds;
}

Case prepare(Device& device, test::ExtremeMesh extreme) {
    Scene scene;
    scene.instances.push_back({.name = "", .mesh = 0});
    scene.meshes.push_back(extreme.mesh);
    std::vector<Aabb> boxes;
    for (const glm::uvec3& triangle : extreme.mesh.triangles) boxes.push_back(test::box_of(extreme.mesh, triangle));
    Case made{std::move(extreme), upload(device, scene), {}};
    made.trees = lbvh_trees(device, upload(device, boxes, "boxes"), {0, static_cast<std::uint32_t>(boxes.size())},
                            MortonBits::bits30);
    return made;
}

double fit_ms(Device& device, const Case& one, Bounds kind) {
    device.take_profile();
    obb_volumes(device, one.trees.topology, one.trees.volumes, one.geometry, {.kind = kind});
    return device.take_profile().total_ms();
}

struct Errors {
    std::size_t outside = 0; ///< Vertices that stick out of an ancestor's box, in double precision.
    double excess = 0.0;     ///< Most that a box of exact extents is wider than the vertices, of the node's size.
};

/// Every vertex against every ancestor, in double precision.
Errors errors_of(Device& device, const Case& one, Bounds kind) {
    const std::vector<Obb> boxes =
        download(device, obb_volumes(device, one.trees.topology, one.trees.volumes, one.geometry, {.kind = kind}));
    const std::vector<std::uint32_t> order = download(device, one.trees.topology.order);
    const std::vector<std::uint32_t> parents = download(device, one.trees.topology.parents);
    std::vector<glm::dvec3> farthest(boxes.size(), glm::dvec3(0.0));
    Errors errors;
    for (std::size_t i = 0; i < order.size(); ++i) {
        const glm::uvec3 corners = one.extreme.mesh.triangles[order[i]];
        for (std::size_t node = order.size() + i; node != BOXWOOD_NONE; node = parents[node]) {
            const Obb& box = boxes[node];
            for (int corner = 0; corner < 3; ++corner) {
                const glm::dvec3 p = glm::dvec3(one.extreme.mesh.positions[corners[corner]]) -
                                     glm::dvec3(box.center[0], box.center[1], box.center[2]);
                bool inside = true;
                for (int k = 0; k < 3; ++k) {
                    const double along =
                        std::fabs(box.axes[3 * k] * p.x + box.axes[3 * k + 1] * p.y + box.axes[3 * k + 2] * p.z);
                    farthest[node][k] = std::max(farthest[node][k], along);
                    inside = inside && along <= box.extent[k];
                }
                if (!inside) ++errors.outside;
            }
        }
    }
    for (std::size_t node = 0; node < boxes.size(); ++node) {
        const glm::dvec3 extent(boxes[node].extent[0], boxes[node].extent[1], boxes[node].extent[2]);
        const double size = std::max({extent.x, extent.y, extent.z});
        if (extent.x < 0.0 || size <= 0.0) continue;
        for (int k = 0; k < 3; ++k) errors.excess = std::max(errors.excess, (extent[k] - farthest[node][k]) / size);
    }
    return errors;
}

int run(int argc, char** argv) {
    CLI::App app("Times oriented boxes over meshes at the extremes, and checks what they hold.");
    benchmarks::Arguments arguments;
    benchmarks::add_arguments(app, arguments);
    CLI11_PARSE(app, argc, argv);

    Device device(arguments.device);
    const std::vector<Bounds> kinds = oriented_kinds();
    std::vector<Case> cases;
    for (test::ExtremeMesh& extreme : test::extreme_meshes(triangles, 1))
        cases.push_back(prepare(device, std::move(extreme)));
    std::printf("device: %s; %zu triangles\n", device.info().name.c_str(), triangles);
    std::printf("%-28s %8s %8s   time against the ordinary mesh\n%-28s %8s %8s", "", "outside", "excess", "mesh", "all",
                "points");
    for (const Bounds kind : kinds) std::printf(" %10s", std::string(name(kind)).substr(4).c_str());
    std::printf("\n");

    std::vector<std::vector<std::vector<double>>> times(cases.size(), std::vector<std::vector<double>>(kinds.size()));
    for (int round = -1; round < arguments.rounds; ++round)
        for (std::size_t i = 0; i < cases.size(); ++i)
            for (std::size_t k = 0; k < kinds.size(); ++k) {
                const double ms = fit_ms(device, cases[i], kinds[k]);
                if (round >= 0) times[i][k].push_back(ms); // the first warms
            }
    std::size_t outside = 0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        Errors worst;
        for (const Bounds kind : kinds) {
            const Errors errors = errors_of(device, cases[i], kind);
            worst.outside += errors.outside;
            if (kind == Bounds::obb_points) worst.excess = errors.excess;
        }
        outside += worst.outside;
        std::printf("%-28s %8zu %8.1e", cases[i].extreme.words.c_str(), worst.outside, worst.excess);
        for (std::size_t k = 0; k < kinds.size(); ++k)
            std::printf(" %10.2f", median(times[i][k]) / median(times[0][k]));
        std::printf("\n");
    }
    return outside == 0 ? 0 : 1;
}

} // namespace
} // namespace boxwood

int main(int argc, char** argv) {
    return boxwood::benchmarks::guarded("boxwood-benchmark-extremes", [&] { return boxwood::run(argc, argv); });
}
