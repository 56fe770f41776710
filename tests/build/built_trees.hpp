// SPDX-License-Identifier: MIT
// Trees over small meshes, on the device and on the host, for the tests of layouts and of whole trees.
#pragma once

#include <vector>

#include "boxwood/geometry.hpp"
#include "boxwood/scene.hpp"
#include "boxwood/tree_image.hpp"
#include "build/trees.hpp"
#include "oracles/tree_checker.hpp"
#include "oracles/triangle_box.hpp"
#include "support.hpp"

namespace boxwood::test {

/// Triangles with corners near random places; `spread` parts the places, `size` the corners.
inline Mesh random_mesh(std::size_t triangles, float spread, float size, std::uint64_t salt) {
    Random random(salt);
    Mesh mesh;
    for (std::uint32_t i = 0; i < triangles; ++i) {
        const glm::vec3 place(random.uniform(-spread, spread), random.uniform(-spread, spread),
                              random.uniform(-spread, spread));
        for (int k = 0; k < 3; ++k)
            mesh.positions.push_back(place + glm::vec3(random.uniform(-size, size), random.uniform(-size, size),
                                                       random.uniform(-size, size)));
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return mesh;
}

/// One identity instance of each mesh.
inline Scene scene_of(std::vector<Mesh> meshes) {
    Scene scene;
    scene.meshes = std::move(meshes);
    for (std::uint32_t i = 0; i < scene.meshes.size(); ++i) scene.instances.push_back({"", i, glm::mat4(1.0f)});
    return scene;
}

/// The same bytes in both.
inline bool same_trees(const TreeImage& a, const TreeImage& b) {
    return same_bits(a.binary_nodes, b.binary_nodes) && same_bits(a.triangles, b.triangles) &&
           same_bits(a.wide_nodes, b.wide_nodes) && same_bits(a.blocks, b.blocks) &&
           same_bits(a.binary_top, b.binary_top) && same_bits(a.wide_top, b.wide_top) &&
           same_bits(a.oriented_nodes, b.oriented_nodes) && same_bits(a.oriented_top, b.oriented_top) &&
           same_bits(a.instances, b.instances) && same_bits(a.first_triangles, b.first_triangles) &&
           a.bottom_depth == b.bottom_depth && a.top_depth == b.top_depth;
}

/// A tree per mesh of a scene.
struct BuiltTrees {
    Geometry geometry;
    BinaryTrees trees;
    HostTopology topology;
    std::vector<Aabb> volumes;
};

inline BuiltTrees build_trees_of(Device& device, const Scene& scene) {
    std::vector<Aabb> boxes;
    std::vector<std::uint32_t> offsets{0};
    for (const Mesh& mesh : scene.meshes) {
        for (const glm::uvec3& triangle : mesh.triangles) boxes.push_back(box_of(mesh, triangle));
        offsets.push_back(static_cast<std::uint32_t>(boxes.size()));
    }
    BuiltTrees built;
    built.geometry = upload(device, scene);
    built.trees = lbvh_trees(device, upload(device, boxes, "boxes"), offsets, MortonBits::bits30);
    built.topology = to_host(device, built.trees.topology);
    built.volumes = download(device, built.trees.volumes);
    return built;
}

} // namespace boxwood::test
