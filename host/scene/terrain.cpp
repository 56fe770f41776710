// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/procedural_kinds.hpp"
#include "scene/random.hpp"

namespace boxwood {

namespace {

constexpr int octaves = 7;

// A value in [-1, 1) for every point of the integer lattice.
float lattice(std::uint64_t seed, std::uint32_t x, std::uint32_t z) {
    const std::uint64_t point = (std::uint64_t{x} << 32) | z;
    return static_cast<float>(scramble(seed ^ scramble(point + 0x9e3779b97f4a7c15u)) >> 40) * 0x1p-23f - 1.0f;
}

float value_noise(std::uint64_t seed, float x, float z) {
    const auto column = static_cast<std::uint32_t>(x);
    const auto row = static_cast<std::uint32_t>(z);
    const auto ease = [](float t) { return t * t * (3.0f - 2.0f * t); };
    const float u = ease(x - static_cast<float>(column));
    const float v = ease(z - static_cast<float>(row));
    const float near = glm::mix(lattice(seed, column, row), lattice(seed, column + 1, row), u);
    const float far = glm::mix(lattice(seed, column, row + 1), lattice(seed, column + 1, row + 1), u);
    return glm::mix(near, far, v);
}

// Each octave is twice as fine and half as high. `x` and `z` are in [0, 1].
float height(std::uint64_t seed, float x, float z) {
    float sum = 0.0f;
    float amplitude = 0.25f;
    float frequency = 3.0f;
    for (int octave = 0; octave < octaves; ++octave) {
        sum +=
            amplitude * value_noise(scramble(seed + static_cast<std::uint64_t>(octave)), x * frequency, z * frequency);
        amplitude *= 0.5f;
        frequency *= 2.0f;
    }
    return sum;
}

// From the slopes between the neighbours of each point of a grid with `columns` points a row.
void add_normals(Mesh& mesh, std::uint32_t columns) {
    const auto rows = static_cast<std::uint32_t>(mesh.positions.size() / columns);
    const auto at = [&](std::uint32_t row, std::uint32_t column) {
        return glm::dvec3(mesh.positions[std::size_t{row} * columns + column]);
    };
    mesh.normals.reserve(mesh.positions.size());
    for (std::uint32_t j = 0; j < rows; ++j) {
        for (std::uint32_t i = 0; i < columns; ++i) {
            const glm::dvec3 x = at(j, std::min(i + 1, columns - 1)) - at(j, i > 0 ? i - 1 : 0);
            const glm::dvec3 z = at(std::min(j + 1, rows - 1), i) - at(j > 0 ? j - 1 : 0, i);
            const glm::dvec3 up(-x.y * z.z, x.x * z.z, -z.y * x.x);
            mesh.normals.emplace_back(up / std::sqrt(glm::dot(up, up)));
        }
    }
}

} // namespace

Scene make_terrain(const ProceduralOptions& options) {
    const std::uint64_t cells = (options.triangles != 0 ? std::max<std::uint64_t>(2, options.triangles) : 131'072) / 2;
    const auto width = static_cast<std::uint32_t>(floor_sqrt(cells));
    const auto depth = static_cast<std::uint32_t>(cells / width);

    Mesh mesh{"terrain", {}, {}};
    mesh.positions.reserve((std::size_t{width} + 1) * (depth + 1));
    mesh.triangles.reserve(2 * std::size_t{width} * depth);
    for (std::uint32_t j = 0; j <= depth; ++j) {
        for (std::uint32_t i = 0; i <= width; ++i) {
            const float x = static_cast<float>(i) / static_cast<float>(width);
            const float z = static_cast<float>(j) / static_cast<float>(depth);
            mesh.positions.emplace_back(2.0f * x - 1.0f, height(options.seed, x, z), 2.0f * z - 1.0f);
        }
    }
    for (std::uint32_t j = 0; j < depth; ++j) {
        for (std::uint32_t i = 0; i < width; ++i) {
            const std::uint32_t a = j * (width + 1) + i;
            const std::uint32_t c = a + width + 1;
            mesh.triangles.emplace_back(a, c, a + 1);
            mesh.triangles.emplace_back(a + 1, c, c + 1);
        }
    }
    add_normals(mesh, width + 1);
    Scene scene = single_mesh_scene(std::move(mesh), {0.0, 1.25, 2.0}, {0.0, 0.0, 0.0});
    paint(scene, scene.meshes[0], "grass", {0.24f, 0.34f, 0.13f});
    return scene;
}

} // namespace boxwood
