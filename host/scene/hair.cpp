// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <utility>

#include "scene/procedural_kinds.hpp"
#include "scene/random.hpp"

namespace boxwood {

namespace {

constexpr std::uint32_t segments = 8;
constexpr std::uint64_t strand_triangles = 6 * segments + 2;
constexpr std::uint64_t strands_per_bundle = 32;

/// A curve root + length (t direction + t^2 bend), t in [0, 1], as a prism of three sides.
struct Strand {
    glm::dvec3 root;
    glm::dvec3 direction;
    glm::dvec3 bend;
    double length;
    double radius;
};

// The corners of the cross-section: an equilateral triangle about the origin (its height is rational on purpose).
std::array<glm::dvec3, 3> cross_section(const Strand& strand) {
    const glm::dvec3 up =
        strand.direction.x < 0.5 && strand.direction.x > -0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(strand.direction, up));
    const glm::dvec3 v = glm::cross(strand.direction, u);
    return {strand.radius * u, strand.radius * (-0.5 * u + 0.875 * v), strand.radius * (-0.5 * u - 0.875 * v)};
}

void add_strand(Mesh& mesh, const Strand& strand) {
    const auto section = cross_section(strand);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::uint32_t i = 0; i <= segments; ++i) {
        const double t = static_cast<double>(i) / segments;
        const glm::dvec3 middle = strand.root + strand.length * (t * strand.direction + t * t * strand.bend);
        for (const glm::dvec3& corner : section) mesh.positions.emplace_back(middle + corner);
    }
    mesh.triangles.emplace_back(first, first + 2, first + 1);
    for (std::uint32_t i = 0; i < segments; ++i) {
        for (std::uint32_t side = 0; side < 3; ++side) {
            const std::uint32_t a = first + 3 * i + side, b = first + 3 * i + (side + 1) % 3;
            mesh.triangles.emplace_back(a, b, b + 3);
            mesh.triangles.emplace_back(a, b + 3, a + 3);
        }
    }
    const std::uint32_t last = first + 3 * segments;
    mesh.triangles.emplace_back(last, last + 1, last + 2);
}

// A direction between the axes: every component has at least a third of the length that it would have on the diagonal.
glm::dvec3 oblique_direction(Random& random) {
    const double x = random.uniform(0.5f, 1.0f), y = random.uniform(0.5f, 1.0f), z = random.uniform(0.5f, 1.0f);
    const std::uint64_t signs = random.bits() >> 62;
    return glm::normalize(glm::dvec3(signs & 1 ? x : -x, y, signs & 2 ? z : -z));
}

} // namespace

Scene make_hair(const ProceduralOptions& options) {
    const std::uint64_t strands =
        std::max<std::uint64_t>(1, (options.triangles != 0 ? options.triangles : 100'000) / strand_triangles);
    const std::uint64_t bundles = (strands + strands_per_bundle - 1) / strands_per_bundle;
    std::uint64_t rows = floor_sqrt(bundles);
    if (rows * rows < bundles) ++rows;
    const double cell = 2.0 / static_cast<double>(rows);

    Random random(options.seed);
    Mesh mesh{"hair", {}, {}};
    mesh.positions.reserve(3 * (segments + 1) * strands);
    mesh.triangles.reserve(strand_triangles * strands);
    for (std::uint64_t bundle = 0; bundle < bundles; ++bundle) {
        const glm::dvec3 corner(static_cast<double>(bundle % rows), 0.0, static_cast<double>(bundle / rows));
        const glm::dvec3 root = cell * corner - glm::dvec3(1.0, 0.0, 1.0);
        const glm::dvec3 direction = oblique_direction(random);
        const glm::dvec3 bend = 0.25 * random_point(random, 1.0) - 0.125;
        for (std::uint64_t i = 0; i < strands_per_bundle && bundle * strands_per_bundle + i < strands; ++i) {
            const glm::dvec3 offset = 0.25 * cell * random_point(random, 1.0) * glm::dvec3(1.0, 0.0, 1.0);
            const double length = random.uniform(0.5f, 0.75f);
            add_strand(mesh, {root + offset, direction, bend, length, 0x1p-9 * cell});
        }
    }
    Scene scene = single_mesh_scene(std::move(mesh), {1.5, 1.75, 2.25}, {0.0, 0.25, 0.0});
    paint(scene, scene.meshes[0], "straw", {0.62f, 0.47f, 0.21f});
    return scene;
}

} // namespace boxwood
