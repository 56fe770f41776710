// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "bounds/every_scale.hpp"
#include "bounds/lanes_of.hpp"
#include "oracles/jacobi.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("bounds");

namespace {

const std::string file = "bounds/eigen_test.cl";
constexpr double roundoff = 0x1p-24;

using Matrix = std::array<float, 6>; // xx, yy, zz, xy, xz, yz
using Rows = std::array<float, 9>;

glm::dmat3 to_double(const Matrix& m) { return glm::dmat3(m[0], m[3], m[4], m[3], m[1], m[5], m[4], m[5], m[2]); }

Matrix to_matrix(const glm::dmat3& m) {
    return {float(m[0][0]), float(m[1][1]), float(m[2][2]), float(m[0][1]), float(m[0][2]), float(m[1][2])};
}

std::vector<Rows> eigenvectors(const std::vector<Matrix>& matrices) {
    return in_lanes(file, "eigen_test", std::vector<Rows>(matrices.size()), matrices);
}

glm::dmat3 random_rotation(Random& random) {
    const auto next = [&] { return random.uniform(-1, 1); };
    return glm::mat3_cast(glm::normalize(glm::dquat(next() + 1.5, next(), next(), next())));
}

glm::dmat3 diagonal(const glm::dvec3& d) { return glm::dmat3(d.x, 0, 0, 0, d.y, 0, 0, 0, d.z); }

/// Covariance of points about their mean.
Matrix covariance(const std::vector<glm::dvec3>& points) {
    glm::dvec3 mean(0);
    for (const glm::dvec3& p : points) mean += p / double(points.size());
    glm::dmat3 m(0);
    for (const glm::dvec3& p : points) m += glm::outerProduct(p - mean, p - mean) / double(points.size());
    return to_matrix(m);
}

/// Diagonal and rotated ones, with eigenvalues repeated, zero, negative and far apart; nearly diagonal; any.
std::vector<Matrix> sample_matrices(int count) {
    Random random(1);
    std::vector<Matrix> matrices;
    const glm::dvec3 values[] = {{0, 0, 0},    {1, 1, 1},         {2000, 1, 0}, {1, 0, 0},    {0, 0, 1},
                                 {1, 1, 0},    {0, 1, 1},         {3, 2, 1},    {1, 2, 3},    {1, 1e-12, 1e-12},
                                 {1, 1e-6, 0}, {1, 0.99999, 0.5}, {5, -3, 1},   {-1, -1, -2}, {1, 1e-20, 1e-30}};
    for (const glm::dvec3& v : values) {
        matrices.push_back(to_matrix(diagonal(v)));
        for (int n = 0; n < count; ++n) {
            const glm::dmat3 r = random_rotation(random);
            matrices.push_back(to_matrix(r * diagonal(v) * glm::transpose(r)));
            Matrix near_diagonal = to_matrix(diagonal(v));
            for (int k = 3; k < 6; ++k) near_diagonal[k] = std::ldexp(random.uniform(-1, 1), -int(random.below(60)));
            matrices.push_back(near_diagonal);
        }
    }
    for (int n = 0; n < 20 * count; ++n) {
        Matrix any;
        for (float& entry : any) entry = random.uniform(-1, 1);
        matrices.push_back(any);
    }
    std::vector<glm::dvec3> cube, sphere;
    for (int k = 0; k < 8; ++k) cube.push_back({k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1});
    for (int n = 0; n < 500; ++n) sphere.push_back(random_rotation(random)[0]);
    const std::vector<glm::dvec3> tetrahedron = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    for (int n = 0; n < count; ++n)
        for (std::vector<glm::dvec3> points : {cube, sphere, tetrahedron}) {
            const glm::dmat3 r = random_rotation(random);
            for (glm::dvec3& p : points) p = glm::dvec3(glm::vec3(r * p)) + 10.0;
            matrices.push_back(covariance(points));
        }
    return matrices;
}

/// A normalised row is off by 3/2 roundoffs for its square (three roundings, under a root), and one each for root,
/// reciprocal and product: its length by 4.5. The third row has the lengths of two and 3 roundings of its own: its
/// square is off by 24.
constexpr double frame_bound = 24;

/// The worst entry of F F^T - I, in units of roundoff; negative when the frame is left-handed.
double off_orthonormal(const Rows& rows) {
    glm::dmat3 f;
    for (int k = 0; k < 9; ++k) f[k / 3][k % 3] = rows[k];
    const glm::dmat3 square = glm::transpose(f) * f;
    double worst = 0;
    for (int k = 0; k < 9; ++k) worst = std::max(worst, std::abs(square[k / 3][k % 3] - (k % 4 == 0 ? 1 : 0)));
    return glm::determinant(f) > 0 ? worst / roundoff : -1;
}

} // namespace

TEST_CASE("eigen: eigenvectors: orthonormal, right-handed, by descending eigenvalue, of every kind of matrix") {
    const std::vector<Matrix> matrices = sample_matrices(small_sizes() ? 2 : 100);
    const std::vector<Rows> frames = eigenvectors(matrices);
    double worst_frame = 0, worst_residual = 0, worst_value = 0;
    for (std::size_t i = 0; i < matrices.size(); ++i) {
        CAPTURE(i);
        const double off = off_orthonormal(frames[i]);
        CHECK(off >= 0);
        CHECK(off <= frame_bound);
        worst_frame = std::max(worst_frame, off);
        const glm::dmat3 m = to_double(matrices[i]);
        const Eigen<3> exact =
            eigen<3>({{{m[0][0], m[0][1], m[0][2]}, {m[1][0], m[1][1], m[1][2]}, {m[2][0], m[2][1], m[2][2]}}});
        const double norm = std::max(std::abs(exact.values[0]), std::abs(exact.values[2]));
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3 v(frames[i][3 * k], frames[i][3 * k + 1], frames[i][3 * k + 2]);
            const double value = glm::dot(v, m * v);
            const double residual = glm::length(m * v - value * v);
            // Fifteen rotations in five sweeps, the last two or three of account: a few units of roundoff each.
            CHECK(residual <= 16 * roundoff * norm);
            CHECK(std::abs(value - exact.values[k]) <= 16 * roundoff * norm);
            if (norm == 0) continue;
            worst_residual = std::max(worst_residual, residual / norm / roundoff);
            worst_value = std::max(worst_value, std::abs(value - exact.values[k]) / norm / roundoff);
        }
    }
    MESSAGE("worst in roundoffs: frame " << worst_frame << ", residual " << worst_residual << ", value "
                                         << worst_value);
}

TEST_CASE("eigen: eigenvectors: diagonal matrices have the world's axes") {
    const std::vector<Rows> frames = eigenvectors({{0, 0, 0, 0, 0, 0}, {1, 1, 1, 0, 0, 0}, {2000, 1, 0, 0, 0, 0}});
    for (const Rows& frame : frames) CHECK(frame == Rows{1, 0, 0, 0, 1, 0, 0, 0, 1});
    // diag(0, 1, 2000): z, y, and minus or plus x as handedness has it.
    const Rows turned = eigenvectors({{0, 1, 2000, 0, 0, 0}})[0];
    CHECK(std::abs(turned[2]) == 1);
    CHECK(std::abs(turned[4]) == 1);
    CHECK(std::abs(turned[6]) == 1);
}

TEST_CASE("eigen: eigenvectors: the size of a matrix does not matter, to the bit") {
    std::vector<Matrix> matrices;
    for (const Matrix& m : sample_matrices(small_sizes() ? 1 : 10)) {
        // Only those that stay normal when scaled.
        bool normal = true;
        for (const float entry : m) normal = normal && (entry == 0 || std::abs(entry) > 0x1p-60f);
        if (normal) matrices.push_back(m);
    }
    REQUIRE(matrices.size() > 40);
    const std::vector<Rows> expected = eigenvectors(matrices);
    for (int exponent = -60; exponent <= 60; exponent += 15) {
        CAPTURE(exponent);
        std::vector<Matrix> scaled = matrices;
        for (Matrix& m : scaled)
            for (float& entry : m) entry = std::ldexp(entry, exponent);
        CHECK(same_bits(eigenvectors(scaled), expected));
    }
    for (Matrix& m : matrices)
        for (float& entry : m) entry = std::ldexp(entry, -140); // denormal, few digits left
    for (const Rows& frame : eigenvectors(matrices)) {
        const double off = off_orthonormal(frame);
        CHECK(off >= 0);
        CHECK(off <= frame_bound);
    }
}

TEST_CASE("eigen: eigenvectors: of denormal and of the largest floats as of the same matrix at one") {
    const std::vector<Matrix> matrices = at_one(sample_matrices(small_sizes() ? 1 : 10));
    const std::vector<Rows> expected = eigenvectors(matrices);
    for (const int exponent : end_exponents) {
        CAPTURE(exponent);
        CHECK(same_bits(eigenvectors(times_power(matrices, exponent)), expected));
    }
    // FLT_MAX itself, in every entry, in some, with either sign.
    constexpr float one = 0x1.fffffep0f;
    const std::vector<Matrix> whole{
        {one, one, one, one, one, one}, {one, -one, one, -one, one, -one}, {one, one / 4, 1, 0, one, -one / 2}};
    CHECK(same_bits(eigenvectors(times_power(whole, 127)), eigenvectors(whole)));
}

TEST_CASE("eigen: moments: merged one by one and in pairs, near and far from the origin") {
    constexpr int points = 8;
    Random random(6);
    std::vector<std::array<float, 3 * points + 4>> sets;
    const auto offset_of = [](int n) { return n % 3 == 0 ? 0.0 : n % 3 == 1 ? 1e7 : -300.0; };
    for (int n = 0; n < (small_sizes() ? 24 : 600); ++n) {
        std::array<float, 3 * points + 4> set;
        for (int k = 0; k < 3 * points; ++k)
            set[k] = float(offset_of(n) + 50.0 * random.uniform(-1, 1) * (k % 3 == 0 ? 1 : 0.125));
        // A reference near the points, such as the centre of their box, and a power of two.
        for (int k = 0; k < 3; ++k) set[3 * points + k] = float(offset_of(n) + random.uniform(-20, 20));
        set[3 * points + 3] = std::ldexp(1.0f, int(random.below(20)) - 10);
        sets.push_back(set);
    }
    const auto results = in_lanes(file, "moments_test", std::vector<std::array<float, 18>>(sets.size()), sets);
    for (std::size_t i = 0; i < sets.size(); ++i) {
        CAPTURE(i);
        const auto point = [&](int k) { return glm::dvec3(sets[i][3 * k], sets[i][3 * k + 1], sets[i][3 * k + 2]); };
        glm::dvec3 mean(0);
        for (int k = 0; k < points; ++k) mean += (point(k) - point(0)) / double(points);
        glm::dmat3 m(0);
        for (int k = 0; k < points; ++k) {
            const glm::dvec3 d = point(k) - point(0) - mean;
            m += glm::outerProduct(d, d) / double(points);
        }
        const Matrix exact = to_matrix(m);
        const double factor = sets[i][3 * points + 3];
        // Points are within 100 of each other, and their differences are exact where they matter: at 1e7 they are whole
        // numbers. Seven merges of a few roundings each.
        for (int k = 0; k < 3; ++k) {
            CHECK(std::abs(results[i][k] - mean[k]) <= 16 * roundoff * 100);
            const double moved = (mean[k] + point(0)[k] - sets[i][3 * points + k]) * factor;
            CHECK(std::abs(results[i][9 + k] - moved) <= 16 * roundoff * 100 * factor);
        }
        for (int k = 0; k < 6; ++k) {
            CHECK(std::abs(results[i][3 + k] - exact[k]) <= 64 * roundoff * exact[0]);
            CHECK(std::abs(results[i][12 + k] - exact[k] * factor * factor) <=
                  64 * roundoff * exact[0] * factor * factor);
        }
    }
}
