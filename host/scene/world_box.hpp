// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <limits>
#include <optional>

#include <glm/glm.hpp>

#include "boxwood/scene.hpp"

namespace boxwood {

/// A box in double precision; empty at first.
struct DoubleBox {
    glm::dvec3 lower{std::numeric_limits<double>::infinity()};
    glm::dvec3 upper{-std::numeric_limits<double>::infinity()};

    void add(const glm::dvec3& point);
    glm::dvec3 middle() const { return 0.5 * lower + 0.5 * upper; }
    glm::dvec3 extents() const { return upper - lower; }
    /// Bit k of a corner's index: the upper end of axis k.
    std::array<glm::dvec3, 8> corners() const;
};

/// Of each mesh's positions, in object space. O(vertices).
std::vector<DoubleBox> mesh_boxes(const Scene& scene);

/// Corners of the boxes of a valid scene's meshes where each instance has them, eight for each. O(vertices +
/// instances).
std::vector<glm::dvec3> instance_corners(const Scene& scene);

/// The box of instance_corners; none for an empty scene.
std::optional<DoubleBox> world_box(const Scene& scene);

} // namespace boxwood
