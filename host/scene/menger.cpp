// SPDX-License-Identifier: MIT
#include <array>
#include <utility>
#include <vector>

#include "scene/procedural_kinds.hpp"

namespace boxwood {

namespace {

using Cell = glm::ivec3;

// A cell is solid unless, at some level, two of its three base-3 digits are the middle one.
bool is_solid(Cell cell, int side) {
    for (int axis = 0; axis < 3; ++axis) {
        if (cell[axis] < 0 || cell[axis] >= side) return false;
    }
    for (; side > 1; side /= 3) {
        int middle = 0;
        for (int axis = 0; axis < 3; ++axis) middle += cell[axis] % 3 == 1 ? 1 : 0;
        if (middle >= 2) return false;
        cell /= 3;
    }
    return true;
}

// Lattice points get a vertex when a face first needs one. Faces are made layer by layer in z, so two planes of vertex
// numbers are enough, however deep the sponge is.
class SpongeMesh {
public:
    explicit SpongeMesh(int side) : side_(side) {
        const std::size_t points = static_cast<std::size_t>(side + 1) * static_cast<std::size_t>(side + 1);
        for (auto& plane : planes_) plane.assign(points, none);
    }

    Mesh build() {
        for (int z = 0; z < side_; ++z) {
            for (int y = 0; y < side_; ++y) {
                for (int x = 0; x < side_; ++x) {
                    if (is_solid({x, y, z}, side_)) add_faces({x, y, z});
                }
            }
            planes_[z & 1].assign(planes_[z & 1].size(), none); // becomes the plane at z + 2
        }
        return std::move(mesh_);
    }

private:
    static constexpr std::uint32_t none = 0xffffffffu;

    void add_faces(Cell cell) {
        for (int axis = 0; axis < 3; ++axis) {
            Cell u(0);
            Cell v(0);
            u[(axis + 1) % 3] = 1;
            v[(axis + 2) % 3] = 1;
            Cell normal(0);
            normal[axis] = 1;
            if (!is_solid(cell + normal, side_)) add_quad(cell + normal, u, v);
            if (!is_solid(cell - normal, side_)) add_quad(cell, v, u);
        }
    }

    void add_quad(Cell corner, Cell u, Cell v) {
        const std::array vertices{vertex(corner), vertex(corner + u), vertex(corner + u + v), vertex(corner + v)};
        mesh_.triangles.emplace_back(vertices[0], vertices[1], vertices[2]);
        mesh_.triangles.emplace_back(vertices[0], vertices[2], vertices[3]);
    }

    std::uint32_t vertex(Cell point) {
        std::uint32_t& known = planes_[point.z & 1][static_cast<std::size_t>(point.y) * (side_ + 1) + point.x];
        if (known == none) {
            known = static_cast<std::uint32_t>(mesh_.positions.size());
            mesh_.positions.emplace_back(glm::dvec3(2 * point - side_) / static_cast<double>(side_));
        }
        return known;
    }

    int side_;
    std::array<std::vector<std::uint32_t>, 2> planes_;
    Mesh mesh_{"Menger sponge", {}, {}};
};

} // namespace

Scene make_menger(const ProceduralOptions& options) {
    const std::uint64_t wanted = options.triangles != 0 ? options.triangles : 40'000;
    int side = 1;
    // A face of the sponge belongs to one of its 20^level cells; 2 cells + 4 * 8^level faces are on the outside.
    for (std::uint64_t cells = 20, face_cells = 8; 4 * cells + 8 * face_cells <= wanted; cells *= 20, face_cells *= 8) {
        side *= 3;
    }
    Scene scene = single_mesh_scene(SpongeMesh(side).build(), {1.75, 1.5, 3.25}, {0.0, 0.0, 0.0});
    paint(scene, scene.meshes[0], "sandstone", {0.78f, 0.62f, 0.42f});
    return scene;
}

} // namespace boxwood
