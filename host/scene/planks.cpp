// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <utility>

#include "scene/procedural_kinds.hpp"
#include "scene/random.hpp"

namespace boxwood {

namespace {

constexpr int boards_per_pile = 8;

// Half sizes of a board of length 1.
constexpr glm::dvec3 board_half(0.5, 1.0 / 64.0, 1.0 / 256.0);

void add_board(Mesh& mesh, const glm::dmat3& rotation, const glm::dvec3& center, const glm::dvec3& half) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 sign(corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0);
        mesh.positions.emplace_back(center + rotation * (sign * half));
    }
    constexpr std::array<std::array<std::uint32_t, 4>, 6> faces{
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    for (const auto& face : faces) {
        mesh.triangles.emplace_back(first + face[0], first + face[1], first + face[2]);
        mesh.triangles.emplace_back(first + face[0], first + face[2], first + face[3]);
    }
}

} // namespace

Scene make_planks(const ProceduralOptions& options) {
    const std::uint64_t boards = std::max<std::uint64_t>(1, (options.triangles != 0 ? options.triangles : 48'000) / 12);
    const std::uint64_t piles = (boards + boards_per_pile - 1) / boards_per_pile;
    // A pile stands in each cell of a cubic lattice and reaches far into its neighbours.
    std::uint64_t side = 1;
    while (side * side * side < piles) ++side;
    const double cell = 2.0 / static_cast<double>(side);
    const double length = 2.0 * cell;

    Random random(options.seed);
    Mesh mesh{"planks", {}, {}};
    mesh.positions.reserve(8 * boards);
    mesh.triangles.reserve(12 * boards);
    for (std::uint64_t pile = 0; pile < piles; ++pile) {
        const glm::dvec3 lattice(static_cast<double>(pile % side), static_cast<double>(pile / side % side),
                                 static_cast<double>(pile / (side * side)));
        const glm::dvec3 middle = cell * (lattice + random_point(random, 1.0)) - 1.0;
        const glm::dmat3 rotation = random_rotation(random);
        for (int i = 0; i < boards_per_pile && pile * boards_per_pile + i < boards; ++i) {
            // Boards lie on each other with gaps of half their thickness, pushed a little along.
            const glm::dvec3 shift(0.0625 * random.uniform(-1.0f, 1.0f), 0.0,
                                   3.0 * board_half.z * (i - 0.5 * (boards_per_pile - 1)));
            add_board(mesh, rotation, middle + rotation * (length * shift), length * board_half);
        }
    }
    Scene scene = single_mesh_scene(std::move(mesh), {2.25, 1.75, 3.0}, {0.0, 0.0, 0.0});
    paint(scene, scene.meshes[0], "wood", {0.55f, 0.36f, 0.2f});
    return scene;
}

} // namespace boxwood
