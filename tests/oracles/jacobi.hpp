// SPDX-License-Identifier: MIT
// Eigenvalues and eigenvectors of small symmetric matrices in double precision, by Jacobi's method until nothing is
// left.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace boxwood::test {

template <std::size_t size>
struct Eigen {
    std::array<double, size> values;                    ///< Descending.
    std::array<std::array<double, size>, size> vectors; ///< Row k belongs to values[k].
};

template <std::size_t size>
Eigen<size> eigen(std::array<std::array<double, size>, size> m) {
    std::array<std::array<double, size>, size> rows{};
    for (std::size_t i = 0; i < size; ++i) rows[i][i] = 1;
    bool left = true;
    for (int sweep = 0; left && sweep < 64; ++sweep) {
        left = false;
        for (std::size_t p = 0; p < size; ++p)
            for (std::size_t q = p + 1; q < size; ++q) {
                if (m[p][q] == 0) continue;
                left = true;
                const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
                const double t = std::copysign(1 / (std::abs(theta) + std::hypot(theta, 1)), theta);
                const double c = 1 / std::hypot(t, 1), s = t * c;
                for (std::size_t k = 0; k < size; ++k) {
                    const double a = m[k][p], b = m[k][q];
                    m[k][p] = c * a - s * b;
                    m[k][q] = s * a + c * b;
                }
                for (std::size_t k = 0; k < size; ++k) {
                    const double a = m[p][k], b = m[q][k];
                    m[p][k] = c * a - s * b;
                    m[q][k] = s * a + c * b;
                    const double u = rows[p][k], v = rows[q][k];
                    rows[p][k] = c * u - s * v;
                    rows[q][k] = s * u + c * v;
                }
                m[p][q] = m[q][p] = 0;
            }
    }
    std::array<std::size_t, size> order;
    for (std::size_t i = 0; i < size; ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return m[i][i] > m[j][j]; });
    Eigen<size> result;
    for (std::size_t i = 0; i < size; ++i) {
        result.values[i] = m[order[i]][order[i]];
        result.vectors[i] = rows[order[i]];
    }
    return result;
}

} // namespace boxwood::test
