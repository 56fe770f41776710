// SPDX-License-Identifier: MIT
// Oriented boxes of point sets, and oriented boxes as matrices.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "boxwood/buffer.hpp"
#include "boxwood/geometry.hpp"
#include "shared/obb.h"

namespace boxwood {

/// M = T R S: the affine map of the cube [-0.5, 0.5]^3 onto the box (dissertation 3.1.1). A flat box has columns of
/// zero. Throws InputError for the empty box.
glm::dmat4 to_matrix(const Obb& box);

/// The box that the affine `matrix` maps the cube [-0.5, 0.5]^3 to, rounded outward; its axes are the normals of its
/// faces. Columns of zero, a flat box's, are allowed; the other columns of the linear part must be independent. Throws
/// InputError when they are not, or for values that are not finite or leave the range of float. to_obb(m *
/// to_matrix(box)) updates a box (dissertation 3.1.4), a flat one too.
Obb to_obb(const glm::dmat4& matrix);

/// |det M|, and the area of the six faces; 0 for the empty box.
double volume(const Obb& box);
double surface_area(const Obb& box);

/// Whether a point lies in the box, in double precision.
bool contains(const Obb& box, const glm::dvec3& point);

/// The oriented box of each segment of points by principal component analysis (dissertation 3.1.3; Gottschalk 2000):
/// `positions` holds three finite floats per point, segment s the points [offsets[s], offsets[s + 1]). Second moments
/// are summed about the mean of the segment, in units of its size, so no digits are lost far from the origin. Where two
/// eigenvalues are within 1/8 of each other, as those of a cube, a sphere or a square, a small box of the points that
/// reach farthest in 26 directions is tried too (in the way of DiTO, Larsson and Kallberg 2011), and taken when its
/// area is smaller. Extents are exact, padded by a bound on their rounding, so every point lies in its box. An empty
/// segment gives the empty box. `boxes` has offsets.size() - 1 elements. O(points + segments), balanced over points;
/// about 150 bytes of scratch per point; waits for the device once. Throws InputError for sizes that do not agree.
void fit_obbs(Device& device, BufferView<const float> positions, BufferView<const std::uint32_t> offsets,
              BufferView<Obb> boxes);

/// The oriented box of the triangles of each mesh of `geometry`, its second moments weighted by area and continuous
/// over the triangles, so that it hardly depends on how the surface is cut into them; else as fit_obbs. In a mesh
/// without area all triangles weigh the same, as the line segments or points that they are. `boxes` has one element per
/// mesh.
void fit_mesh_obbs(Device& device, const Geometry& geometry, BufferView<Obb> boxes);

} // namespace boxwood
