// SPDX-License-Identifier: MIT
// The makers behind make_procedural. Each takes options whose zeros are still unresolved. They use only operations that
// IEEE 754 rounds exactly (no sin, cos or pow), so the bytes are the same everywhere.
#pragma once

#include "boxwood/procedural.hpp"
#include "boxwood/scene.hpp"

namespace boxwood {

/// A box open to the viewer with two blocks and a light. 32 k^2 triangles in 8 meshes.
Scene make_cornell(const ProceduralOptions& options);
/// Unconnected triangles of like size in the unit cube; any count.
Scene make_random(const ProceduralOptions& options);
/// A heightfield of fractal value noise over [-1, 1]^2; 2 w h triangles.
Scene make_terrain(const ProceduralOptions& options);
/// The unit sphere as a refined octahedron; 8 f^2 triangles, closed, every vertex shared.
Scene make_sphere(const ProceduralOptions& options);
/// Trees of three kinds placed on a plane; 18 n + 2 stored triangles with n a multiple of 4.
Scene make_forest(const ProceduralOptions& options);
/// The outside faces of a Menger sponge in [-1, 1]^3; 4 * 20^level + 8 * 8^level triangles.
Scene make_menger(const ProceduralOptions& options);
/// Bundles of curved strands over [-1, 1]^2, leaning between the axes; 50 triangles a strand, closed.
Scene make_hair(const ProceduralOptions& options);
/// Piles of long thin boards in [-1, 1]^3, each pile under a random rotation; 12 triangles a board, closed.
Scene make_planks(const ProceduralOptions& options);

/// Spheres of many materials in two rows on a chequered floor, under a lamp and a point light; 96 f^2 + 4 triangles in
/// 14 meshes.
Scene make_materials(const ProceduralOptions& options);

/// The unit sphere of 8 f^2 triangles, f > 0, with its normals.
Mesh sphere_mesh(std::uint64_t f);

/// Adds a material that scatters alike in all directions, and gives all triangles of `mesh` that material.
void paint(Scene& scene, Mesh& mesh, const char* name, glm::vec3 color);

/// The largest integer whose square is not above `value`.
std::uint64_t floor_sqrt(std::uint64_t value);

/// One mesh, one identity instance and one camera that looks from `eye` at `target`.
Scene single_mesh_scene(Mesh mesh, glm::dvec3 eye, glm::dvec3 target);

} // namespace boxwood
