// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "boxwood/scene.hpp"

namespace boxwood {

/// Axis-aligned bounds of a mesh in object space.
struct MeshBounds {
    glm::vec3 min;
    glm::vec3 max;
};

/// The bounds of one position or more. O(positions).
MeshBounds mesh_bounds(const std::vector<glm::vec3>& positions);

/// Whether a linear map flattens space: its determinant is below the rounding error, in float, of its own terms.
bool is_singular(const glm::dmat3& linear);

/// Whether a linear map leaves at least a plane of space, judged likewise.
bool spans_plane(const glm::dmat3& linear);

/// Why a transform is not affine and finite, or "" when it is.
std::string_view affine_fault(const glm::mat4& transform);

/// Why a transform cannot place something, or "" when it can: it must be affine and finite, and have an inverse whose
/// entries are finite floats too. The determinant counts as zero when it is below the rounding error of its own terms,
/// so the answer does not change when the transform is scaled by a power of two.
std::string_view transform_fault(const glm::mat4& transform);

/// True when `transform` keeps every corner of `bounds` within largest_coordinate.
bool stays_in_range(const glm::mat4& transform, const MeshBounds& bounds);

/// Why a transform cannot place a mesh of these bounds, or "": the two tests above.
std::string_view placement_fault(const glm::mat4& transform, const MeshBounds& bounds);

/// Whether a position may be a mesh's: finite, within largest_coordinate.
bool in_range(const glm::vec3& position);

/// A position under an affine transform, in double.
inline glm::dvec3 place(const glm::dmat4& transform, const glm::vec3& position) {
    return glm::dvec3(transform * glm::dvec4(position, 1.0));
}

/// Appends `positions` under `transform` to `target`, computed in double and rounded once.
void append_transformed(const std::vector<glm::vec3>& positions, const glm::mat4& transform,
                        std::vector<glm::vec3>& target);

/// The frame that looks from `eye` to `target` along its local -z with `up` as close to y as it can be.
glm::mat4 look_at(glm::dvec3 eye, glm::dvec3 target, glm::dvec3 up = {0.0, 1.0, 0.0});

} // namespace boxwood
