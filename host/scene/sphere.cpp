// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/gtc/type_precision.hpp>

#include "scene/procedural_kinds.hpp"

namespace boxwood {

namespace {

// The octahedron |x| + |y| + |z| = f has integer points; in ring r (0 at the north pole, 2f at the south pole) there
// are 4 min(r, 2f - r) of them, one at a pole.
struct Rings {
    std::int64_t f;

    std::int64_t quarter(std::int64_t ring) const { return std::min(ring, 2 * f - ring); }
    std::int64_t size(std::int64_t ring) const { return std::max<std::int64_t>(1, 4 * quarter(ring)); }

    /// Index of the first vertex of a ring: 1 + 4 (1 + 2 + ...) counted from the nearer pole.
    std::int64_t start(std::int64_t ring) const {
        if (ring == 0) return 0;
        if (ring <= f) return 1 + 2 * ring * (ring - 1);
        const std::int64_t left =
            2 * f - ring; // quarter of this ring; the rings from here to the pole hold 2 left (left + 1) + 1
        return 4 * f * f + 2 - (2 * left * (left + 1) + 1);
    }

    std::uint32_t vertex(std::int64_t ring, std::int64_t around) const {
        return static_cast<std::uint32_t>(start(ring) + around % size(ring));
    }

    /// Walks the ring counter-clockwise seen from above, from the +x axis.
    glm::vec3 position(std::int64_t ring, std::int64_t around) const {
        const std::int64_t side = quarter(ring);
        const std::int64_t step = side == 0 ? 0 : around % side;
        glm::i64vec2 at(side - step, step);
        for (std::int64_t quadrant = side == 0 ? 0 : around / side; quadrant > 0; --quadrant) at = {-at.y, at.x};
        const glm::dvec3 corner(at.x, f - ring, -at.y);
        return glm::vec3(corner / std::sqrt(glm::dot(corner, corner)));
    }
};

// The band between a ring and the next one away from the pole: per quadrant, `outer` triangles with an edge on the
// outer ring and one less on the inner ring. `flip` turns them round for the southern half.
void add_band(Mesh& mesh, const Rings& rings, std::int64_t inner, std::int64_t outer, bool flip) {
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        mesh.triangles.emplace_back(a, flip ? c : b, flip ? b : c);
    };
    const std::int64_t n = rings.quarter(outer);
    for (std::int64_t quadrant = 0; quadrant < 4; ++quadrant) {
        for (std::int64_t i = 0; i < n; ++i) {
            const std::int64_t on_outer = quadrant * n + i;
            const std::int64_t on_inner = quadrant * (n - 1) + i;
            add(rings.vertex(outer, on_outer), rings.vertex(outer, on_outer + 1), rings.vertex(inner, on_inner));
            if (i + 1 < n) {
                add(rings.vertex(outer, on_outer + 1), rings.vertex(inner, on_inner + 1),
                    rings.vertex(inner, on_inner));
            }
        }
    }
}

} // namespace

Mesh sphere_mesh(std::uint64_t f) {
    const Rings rings{static_cast<std::int64_t>(f)};
    Mesh mesh{"sphere", {}, {}};
    mesh.positions.reserve(static_cast<std::size_t>(4 * rings.f * rings.f + 2));
    mesh.triangles.reserve(static_cast<std::size_t>(8 * rings.f * rings.f));
    for (std::int64_t ring = 0; ring <= 2 * rings.f; ++ring) {
        for (std::int64_t i = 0; i < rings.size(ring); ++i) mesh.positions.push_back(rings.position(ring, i));
    }
    for (std::int64_t ring = 0; ring < rings.f; ++ring) add_band(mesh, rings, ring, ring + 1, false);
    for (std::int64_t ring = rings.f; ring < 2 * rings.f; ++ring) add_band(mesh, rings, ring + 1, ring, true);
    mesh.normals = mesh.positions;
    return mesh;
}

Scene make_sphere(const ProceduralOptions& options) {
    const std::uint64_t wanted = options.triangles != 0 ? options.triangles : 32'768;
    Mesh mesh = sphere_mesh(std::max<std::uint64_t>(1, floor_sqrt(wanted / 8)));
    Scene scene = single_mesh_scene(std::move(mesh), {0.0, 1.0, 3.0}, {0.0, 0.0, 0.0});
    paint(scene, scene.meshes[0], "glaze", {0.85f, 0.35f, 0.12f});
    scene.materials[0].specular = 1.0f;
    scene.materials[0].roughness = 0.25f;
    return scene;
}

} // namespace boxwood
