// SPDX-License-Identifier: MIT
#include "oracles/reference_obb.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace boxwood::test {

namespace {

glm::dvec3 random_direction(Random& random) {
    glm::dvec3 v;
    do {
        for (int k = 0; k < 3; ++k) v[k] = random.uniform(-1.0f, 1.0f);
    } while (glm::length(v) < 0.1 || glm::length(v) > 1.0);
    return glm::normalize(v);
}

float rounded_up(double value) {
    const auto nearest = static_cast<float>(value);
    return static_cast<double>(nearest) < value ? std::nextafter(nearest, std::numeric_limits<float>::infinity())
                                                : nearest;
}

} // namespace

glm::dmat3 random_rows(Random& random, bool sheared) {
    glm::dmat3 rows;
    do {
        rows[0] = random_direction(random);
        rows[1] = random_direction(random);
        rows[2] = random_direction(random);
    } while (std::abs(glm::determinant(rows)) < 0.3);
    if (sheared) {
        for (int k = 0; k < 3; ++k) rows[k] *= random.uniform(0.5f, 2.0f);
    } else {
        rows[1] = glm::normalize(glm::cross(rows[2], rows[0]));
        rows[2] = glm::cross(rows[0], rows[1]);
    }
    return glm::dmat3(glm::mat3(rows));
}

Obb box_around(const glm::dmat3& rows, const std::vector<glm::dvec3>& points, double slack) {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
    for (const glm::dvec3& p : points) {
        const glm::dvec3 local(along(rows, 0, p), along(rows, 1, p), along(rows, 2, p));
        low = glm::min(low, local), high = glm::max(high, local);
    }
    Obb box{};
    // glm's matrices are columns, so the rows' matrix is the transposed one.
    const glm::vec3 center(glm::inverse(glm::transpose(rows)) * (0.5 * (low + high)));
    for (int k = 0; k < 3; ++k) {
        box.center[k] = center[k];
        for (int j = 0; j < 3; ++j) box.axes[3 * k + j] = static_cast<float>(rows[k][j]);
        const glm::dvec3 size = glm::abs(rows[k]);
        double reach = 0.0;
        for (const glm::dvec3& p : points) reach = std::max(reach, std::abs(along(rows, k, p - glm::dvec3(center))));
        box.extent[k] = rounded_up(reach + slack * (size.x + size.y + size.z));
    }
    return box;
}

glm::dmat3 rows_of(const Obb& box) {
    glm::dmat3 rows;
    for (int k = 0; k < 3; ++k)
        for (int j = 0; j < 3; ++j) rows[k][j] = box.axes[3 * k + j];
    return rows;
}

void store_volume(const Obb& box, float* volume) {
    for (int k = 0; k < 3; ++k) {
        volume[k] = box.center[k];
        volume[3 + k] = box.extent[k];
        for (int row = 0; row < 3; ++row) volume[6 + 3 * k + row] = box.axes[3 * row + k];
    }
}

} // namespace boxwood::test
