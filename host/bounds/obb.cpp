// SPDX-License-Identifier: MIT
#include "boxwood/obb.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "boxwood/error.hpp"

namespace boxwood {

namespace {

bool is_empty(const Obb& box) { return !(box.extent[0] >= 0 && box.extent[1] >= 0 && box.extent[2] >= 0); }

glm::dvec3 axis_of(const Obb& box, int k) {
    return glm::dvec3(box.axes[3 * k], box.axes[3 * k + 1], box.axes[3 * k + 2]);
}

/// The edges of the box, as columns.
glm::dmat3 edges_of(const Obb& box) {
    const glm::dmat3 rows = glm::transpose(glm::dmat3(axis_of(box, 0), axis_of(box, 1), axis_of(box, 2)));
    glm::dmat3 edges = glm::inverse(rows);
    for (int k = 0; k < 3; ++k) edges[k] *= 2.0 * box.extent[k];
    return edges;
}

/// The smallest float not below.
float round_up(double value) {
    const float nearest = static_cast<float>(value);
    return nearest < value ? std::nextafter(nearest, std::numeric_limits<float>::infinity()) : nearest;
}

/// Some unit vector perpendicular to a unit vector.
glm::dvec3 perpendicular(const glm::dvec3& v) {
    const glm::dvec3 a = glm::abs(v);
    const glm::dvec3 other = a.x <= a.y && a.x <= a.z ? glm::dvec3(1, 0, 0)
                             : a.y <= a.z             ? glm::dvec3(0, 1, 0)
                                                      : glm::dvec3(0, 0, 1);
    return glm::normalize(glm::cross(v, other));
}

/// The directions of three edges; those of edges without length are chosen perpendicular to the others.
glm::dmat3 directions_of(const glm::dmat3& edges) {
    glm::dmat3 directions(0.0);
    std::array<bool, 3> known{};
    for (int k = 0; k < 3; ++k) {
        // By the largest component first, so that no square under- or overflows.
        const glm::dvec3 a = glm::abs(edges[k]);
        const double largest = std::max(a.x, std::max(a.y, a.z));
        known[k] = largest > 0;
        if (known[k]) directions[k] = glm::normalize(edges[k] / largest);
    }
    if (!known[0] && !known[1] && !known[2]) return glm::dmat3(1.0);
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        if (known[k]) continue;
        if (known[i] != known[j])
            directions[k] = perpendicular(directions[known[i] ? i : j]);
        else
            directions[k] = glm::normalize(glm::cross(directions[i], directions[j]));
        known[k] = true;
    }
    return directions;
}

} // namespace

glm::dmat4 to_matrix(const Obb& box) {
    if (is_empty(box)) throw InputError("arguments", "box", "is empty; only a box that holds a point has a matrix");
    glm::dmat4 matrix(edges_of(box));
    matrix[3] = glm::dvec4(box.center[0], box.center[1], box.center[2], 1);
    return matrix;
}

Obb to_obb(const glm::dmat4& matrix) {
    const glm::dmat3 edges(matrix);
    const glm::dvec3 center(matrix[3]);
    const glm::dmat3 rows = glm::transpose(glm::inverse(directions_of(edges)));

    Obb box{};
    glm::dvec3 moved;
    for (int k = 0; k < 3; ++k) {
        box.center[k] = static_cast<float>(center[k]);
        moved[k] = center[k] - box.center[k];
    }
    bool finite = true;
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 axis = glm::normalize(rows[k]);
        for (int c = 0; c < 3; ++c) box.axes[3 * k + c] = static_cast<float>(axis[c]);
        // How far the box reaches along the axis as stored, from the centre as stored. Every sum of three products is
        // off by at most 3 units of roundoff of its terms' magnitudes; there are four and two additions.
        const glm::dvec3 stored = axis_of(box, k);
        double reach = std::abs(glm::dot(stored, moved)), size = glm::dot(glm::abs(stored), glm::abs(moved));
        for (int j = 0; j < 3; ++j) {
            reach += std::abs(glm::dot(stored, edges[j])) / 2;
            size += glm::dot(glm::abs(stored), glm::abs(edges[j])) / 2;
        }
        box.extent[k] = round_up(reach + 8 * 0x1p-53 * size);
        finite = finite && std::isfinite(box.extent[k]) && std::isfinite(glm::dot(stored, stored)) &&
                 std::isfinite(box.center[k]);
    }
    if (!finite)
        throw InputError("arguments", "matrix",
                         "is singular, not finite, or beyond the range of float; give an affine "
                         "map of the cube with edges that are independent or zero");
    return box;
}

double volume(const Obb& box) { return is_empty(box) ? 0.0 : std::abs(glm::determinant(edges_of(box))); }

double surface_area(const Obb& box) {
    if (is_empty(box)) return 0.0;
    const glm::dmat3 e = edges_of(box);
    return 2 * (glm::length(glm::cross(e[0], e[1])) + glm::length(glm::cross(e[1], e[2])) +
                glm::length(glm::cross(e[2], e[0])));
}

bool contains(const Obb& box, const glm::dvec3& point) {
    const glm::dvec3 offset = point - glm::dvec3(box.center[0], box.center[1], box.center[2]);
    for (int k = 0; k < 3; ++k)
        if (!(std::abs(glm::dot(axis_of(box, k), offset)) <= box.extent[k])) return false;
    return true;
}

} // namespace boxwood
