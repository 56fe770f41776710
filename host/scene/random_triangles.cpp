// SPDX-License-Identifier: MIT
#include <utility>

#include "scene/procedural_kinds.hpp"
#include "scene/random.hpp"

namespace boxwood {

Scene make_random(const ProceduralOptions& options) {
    const std::uint64_t count = options.triangles != 0 ? options.triangles : 10'000;
    // Halve the size for every factor of eight in the count: about one triangle for every cell of a grid of that size.
    float size = 0.5f;
    for (std::uint64_t cells = 8; cells <= count; cells *= 8) size *= 0.5f;

    Random random(options.seed);
    // Arguments of one call may be evaluated in any order, so draw in separate statements.
    const auto point = [&random](float extent) {
        glm::vec3 drawn;
        for (int axis = 0; axis < 3; ++axis) drawn[axis] = random.uniform(0.0f, extent);
        return drawn;
    };
    Mesh mesh{"random triangles", {}, {}};
    mesh.positions.reserve(3 * count);
    mesh.triangles.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::vec3 corner = point(1.0f - size);
        for (int vertex = 0; vertex < 3; ++vertex) mesh.positions.push_back(corner + point(size));
        mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    return single_mesh_scene(std::move(mesh), {1.75, 1.5, 2.5}, {0.5, 0.5, 0.5});
}

} // namespace boxwood
