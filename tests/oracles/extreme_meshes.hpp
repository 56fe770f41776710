// SPDX-License-Identifier: MIT
// Meshes at the extremes of shape and of float, for the tests and the benchmark of bounding volumes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "boxwood/scene.hpp"

namespace boxwood::test {

struct ExtremeMesh {
    std::string words;
    Mesh mesh;
};

/// About `triangles` triangles each; the first is an ordinary one, triangles of all directions in a cube.
std::vector<ExtremeMesh> extreme_meshes(std::size_t triangles, std::uint64_t seed);

/// Triangles of all directions in the cube [-1, 1]^3.
Mesh cube_of_triangles(std::size_t triangles, std::uint64_t seed);

/// A cube of half size 50, turned about an oblique axis, n x n squares per face.
Mesh turned_cube(std::uint32_t n);

} // namespace boxwood::test
