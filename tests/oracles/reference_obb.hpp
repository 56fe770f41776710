// SPDX-License-Identifier: MIT
// Oriented boxes in double precision, turned and sheared at random: for tests of what reads them, not of fits.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "shared/obb.h"
#include "support.hpp"

namespace boxwood::test {

/// Rows of axes, rounded to float: a rotation or, when `sheared`, three independent rows of lengths 0.5 to 2 whose
/// matrix is well conditioned.
glm::dmat3 random_rows(Random& random, bool sheared);

/// Row k of `rows` (stored as column k of the matrix) times v.
inline double along(const glm::dmat3& rows, int k, const glm::dvec3& v) { return glm::dot(rows[k], v); }

/// The smallest box of those axes that holds the points, each widened by `slack` along every coordinate: centre and
/// extents rounded to float, the extents so that every point stays inside.
Obb box_around(const glm::dmat3& rows, const std::vector<glm::dvec3>& points, double slack = 0.0);

/// The rows of a box, as random_rows gives them.
glm::dmat3 rows_of(const Obb& box);

/// The fifteen floats of an OrientedNode's volume.
void store_volume(const Obb& box, float* volume);

} // namespace boxwood::test
