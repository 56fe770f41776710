// SPDX-License-Identifier: MIT
// The box spans [-1, 1]^3, open towards +z. Blocks are turned by angles with rational sine and cosine, so that every
// corner has a closed form.
#include <algorithm>
#include <vector>

#include "scene/procedural_kinds.hpp"
#include "scene/transform.hpp"

namespace boxwood {

namespace {

constexpr std::uint64_t quads = 16;

// Adds the parallelogram corner, corner + u, corner + u + v, corner + v as cells x cells pairs of triangles, facing
// cross(u, v).
void add_quad(Mesh& mesh, glm::dvec3 corner, glm::dvec3 u, glm::dvec3 v, std::uint32_t cells) {
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::uint32_t j = 0; j <= cells; ++j) {
        for (std::uint32_t i = 0; i <= cells; ++i) {
            const glm::dvec2 at = glm::dvec2(i, j) / static_cast<double>(cells);
            mesh.positions.emplace_back(corner + u * at.x + v * at.y);
        }
    }
    for (std::uint32_t j = 0; j < cells; ++j) {
        for (std::uint32_t i = 0; i < cells; ++i) {
            const std::uint32_t a = base + j * (cells + 1) + i;
            const std::uint32_t c = a + cells + 1;
            mesh.triangles.emplace_back(a, a + 1, c + 1);
            mesh.triangles.emplace_back(a, c + 1, c);
        }
    }
}

struct Block {
    const char* name;
    glm::dvec3 centre; ///< Of the bottom.
    glm::dvec2 turn;   ///< Cosine and sine about y.
    double half_width;
    double height;
};

// A block standing on the floor: four sides and a top.
Mesh make_block(const Block& block, std::uint32_t cells) {
    Mesh mesh{block.name, {}, {}};
    const glm::dvec3 x = block.half_width * glm::dvec3(block.turn.x, 0.0, -block.turn.y);
    const glm::dvec3 z = block.half_width * glm::dvec3(block.turn.y, 0.0, block.turn.x);
    const glm::dvec3 up(0.0, block.height, 0.0);
    const glm::dvec3& c = block.centre;
    add_quad(mesh, c - x + z, 2.0 * x, up, cells);
    add_quad(mesh, c + x + z, -2.0 * z, up, cells);
    add_quad(mesh, c + x - z, -2.0 * x, up, cells);
    add_quad(mesh, c - x - z, 2.0 * z, up, cells);
    add_quad(mesh, c - x + z + up, 2.0 * x, -2.0 * z, cells);
    return mesh;
}

Mesh make_wall(const char* name, glm::dvec3 corner, glm::dvec3 u, glm::dvec3 v, std::uint32_t cells) {
    Mesh mesh{name, {}, {}};
    add_quad(mesh, corner, u, v, cells);
    return mesh;
}

// Matt walls and blocks, the left wall red and the right one green; the lamp gives light downwards and reflects none.
void add_materials(Scene& scene) {
    std::vector<Mesh>& meshes = scene.meshes;
    paint(scene, meshes[0], "white", glm::vec3(0.73f));
    for (const std::size_t white : {1, 2, 5, 6}) meshes[white].materials.assign(meshes[white].triangles.size(), 0);
    paint(scene, meshes[3], "red", {0.63f, 0.065f, 0.05f});
    paint(scene, meshes[4], "green", {0.14f, 0.45f, 0.091f});
    paint(scene, meshes[7], "lamp", glm::vec3(0.0f));
    scene.materials.back().emission = glm::vec3(15.0f);
}

} // namespace

Scene make_cornell(const ProceduralOptions& options) {
    const auto cells =
        static_cast<std::uint32_t>(std::max<std::uint64_t>(1, floor_sqrt(options.triangles / (2 * quads))));
    Scene scene;
    scene.meshes = {
        make_wall("floor", {-1, -1, 1}, {2, 0, 0}, {0, 0, -2}, cells),
        make_wall("ceiling", {-1, 1, -1}, {2, 0, 0}, {0, 0, 2}, cells),
        make_wall("back wall", {-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, cells),
        make_wall("left wall", {-1, -1, 1}, {0, 0, -2}, {0, 2, 0}, cells),
        make_wall("right wall", {1, -1, -1}, {0, 0, 2}, {0, 2, 0}, cells),
        make_block({"short block", {0.375, -1, 0.375}, {24.0 / 25, -7.0 / 25}, 0.28125, 0.5625}, cells),
        make_block({"tall block", {-0.3125, -1, -0.25}, {12.0 / 13, 5.0 / 13}, 0.28125, 1.1875}, cells),
        make_wall("light", {-0.25, 0.9921875, -0.25}, {0.5, 0, 0}, {0, 0, 0.5}, cells),
    };
    for (std::uint32_t i = 0; i < scene.meshes.size(); ++i) {
        scene.instances.push_back({scene.meshes[i].name, i, glm::mat4(1.0f)});
    }
    add_materials(scene);
    scene.cameras.push_back({"camera", look_at({0, 0, 4}, {0, 0, 0}), true, 0.6875f});
    return scene;
}

} // namespace boxwood
