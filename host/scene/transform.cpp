// SPDX-License-Identifier: MIT
#include "scene/transform.hpp"

#include <algorithm>
#include <cfloat>
#include <cmath>

#include <glm/gtc/matrix_inverse.hpp>

namespace boxwood {

namespace {

template <class Matrix>
bool all_finite(const Matrix& matrix) {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            if (!std::isfinite(static_cast<float>(matrix[column][row]))) return false;
        }
    }
    return true;
}

constexpr double rounding = static_cast<double>(FLT_EPSILON);

/// Whether two of the columns point in different directions.
bool has_area(const glm::dmat3& columns) {
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 &a = columns[i], &b = columns[(i + 1) % 3];
        if (glm::length(glm::cross(a, b)) > rounding * glm::length(a) * glm::length(b)) return true;
    }
    return false;
}

} // namespace

// Hadamard's bound on the determinant, by columns and by rows: a matrix whose rows or columns differ in scale only is
// far from singular, however thin it is.
bool is_singular(const glm::dmat3& linear) {
    const glm::dmat3 rows = glm::transpose(linear);
    const double by_columns = glm::length(linear[0]) * glm::length(linear[1]) * glm::length(linear[2]);
    const double by_rows = glm::length(rows[0]) * glm::length(rows[1]) * glm::length(rows[2]);
    return !(std::abs(glm::determinant(linear)) > rounding * std::min(by_columns, by_rows));
}

bool spans_plane(const glm::dmat3& linear) { return has_area(linear) || has_area(glm::transpose(linear)); }

std::string_view affine_fault(const glm::mat4& transform) {
    if (!all_finite(transform)) return "is not finite";
    if (transform[0][3] != 0.0f || transform[1][3] != 0.0f || transform[2][3] != 0.0f || transform[3][3] != 1.0f) {
        return "is not affine";
    }
    return "";
}

MeshBounds mesh_bounds(const std::vector<glm::vec3>& positions) {
    MeshBounds bounds{positions.front(), positions.front()};
    for (const glm::vec3& position : positions) {
        bounds.min = glm::min(bounds.min, position);
        bounds.max = glm::max(bounds.max, position);
    }
    return bounds;
}

std::string_view transform_fault(const glm::mat4& transform) {
    const std::string_view fault = affine_fault(transform);
    if (!fault.empty()) return fault;
    const glm::dmat4 exact(transform);
    if (is_singular(glm::dmat3(exact))) return "is singular";
    if (!all_finite(glm::affineInverse(exact))) return "has an inverse out of the range of float";
    return "";
}

bool stays_in_range(const glm::mat4& transform, const MeshBounds& bounds) {
    const glm::dmat4 exact(transform);
    // Nearly always a bound on all corners at once is enough; half the range leaves room for rounding.
    const glm::dvec3 reach(glm::max(glm::abs(bounds.min), glm::abs(bounds.max)));
    bool surely = true;
    for (int row = 0; row < 3; ++row) {
        const double farthest = std::abs(exact[0][row]) * reach.x + std::abs(exact[1][row]) * reach.y +
                                std::abs(exact[2][row]) * reach.z + std::abs(exact[3][row]);
        surely = surely && farthest <= 0.5 * static_cast<double>(largest_coordinate);
    }
    if (surely) return true;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec4 position((corner & 1) != 0 ? bounds.max.x : bounds.min.x,
                                  (corner & 2) != 0 ? bounds.max.y : bounds.min.y,
                                  (corner & 4) != 0 ? bounds.max.z : bounds.min.z, 1.0);
        const glm::dvec3 placed(exact * position);
        const double largest = std::max({std::abs(placed.x), std::abs(placed.y), std::abs(placed.z)});
        if (!(largest <= static_cast<double>(largest_coordinate))) return false;
    }
    return true;
}

std::string_view placement_fault(const glm::mat4& transform, const MeshBounds& bounds) {
    const std::string_view fault = transform_fault(transform);
    return fault.empty() && !stays_in_range(transform, bounds) ? "moves its mesh out of range" : fault;
}

bool in_range(const glm::vec3& position) {
    const glm::vec3 size = glm::abs(position); // a NaN fails every comparison below
    return size.x <= largest_coordinate && size.y <= largest_coordinate && size.z <= largest_coordinate;
}

void append_transformed(const std::vector<glm::vec3>& positions, const glm::mat4& transform,
                        std::vector<glm::vec3>& target) {
    const glm::dmat4 exact(transform);
    for (const glm::vec3& position : positions) target.emplace_back(place(exact, position));
}

glm::mat4 look_at(glm::dvec3 eye, glm::dvec3 target, glm::dvec3 up) {
    const glm::dvec3 back = glm::normalize(eye - target);
    const glm::dvec3 right = glm::normalize(glm::cross(up, back));
    const glm::dvec3 above = glm::cross(back, right);
    return glm::mat4(
        glm::dmat4(glm::dvec4(right, 0.0), glm::dvec4(above, 0.0), glm::dvec4(back, 0.0), glm::dvec4(eye, 1.0)));
}

} // namespace boxwood
