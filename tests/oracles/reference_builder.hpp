// SPDX-License-Identifier: MIT
// A plain tree builder on the host, so that traversal is tested apart from the device's builders.
#pragma once

#include <array>
#include <vector>

#include "boxwood/scene.hpp"
#include "boxwood/tree_image.hpp"

namespace boxwood::test {

/// How boxes are split: by the surface area heuristic over 16 bins, or the last along x from all the others, which
/// gives the deepest tree there is.
enum class Shape { sah, chain };

/// A valid image of the scene, exact float boxes over the vertices below, conservative ones above. For any oriented
/// kind three of four nodes have an oriented box with axes at random (see reference_obb.hpp), one in four a sheared
/// one.
TreeImage reference_tree(const Scene& scene, Layout layout, Levels levels, Bounds bounds = Bounds::aabb,
                         Shape shape = Shape::sah);

/// The triangles of a mesh.
std::vector<std::array<glm::vec3, 3>> corners(const Mesh& mesh);

/// The triangles of an instance in world space, transformed in double and rounded once.
std::vector<std::array<glm::vec3, 3>> world_corners(const Scene& scene, const Instance& instance);

/// Records of all instances, root 0; inverted in double and rounded once.
std::vector<InstanceRecord> reference_records(const Scene& scene);

} // namespace boxwood::test
