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

const std::string file = "bounds/rotation_test.cl";

using Floats4 = std::array<float, 4>; // x, y, z, w
using Floats9 = std::array<float, 9>; // three vectors

glm::dquat to_double(const Floats4& q) { return glm::dquat(q[3], q[0], q[1], q[2]); }
Floats4 to_float(const glm::dquat& q) {
    return {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z), static_cast<float>(q.w)};
}
Floats9 columns(const glm::dmat3& m) {
    Floats9 values;
    for (int k = 0; k < 9; ++k) values[k] = static_cast<float>(m[k / 3][k % 3]);
    return values;
}
glm::dmat3 matrix_of(const Floats9& values) {
    glm::dmat3 m;
    for (int k = 0; k < 9; ++k) m[k / 3][k % 3] = values[k];
    return m;
}

/// Distance of rotations: q and -q are the same.
double apart(const glm::dquat& p, const glm::dquat& q) { return std::min(glm::length(p - q), glm::length(p + q)); }

glm::dquat random_rotation(Random& random) {
    while (true) {
        const glm::dquat q(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        if (const double length = glm::length(q); length > 0.1 && length < 1) return q / length;
    }
}

/// The 24 rotations of the cube, by closing two quarter turns under multiplication.
std::vector<glm::dquat> cube_rotations() {
    const double h = std::sqrt(0.5);
    const glm::dquat turns[2] = {glm::dquat(h, h, 0, 0), glm::dquat(h, 0, h, 0)};
    std::vector<glm::dquat> group{glm::dquat(1, 0, 0, 0)};
    for (std::size_t i = 0; i < group.size(); ++i)
        for (const glm::dquat& turn : turns) {
            const glm::dquat next = group[i] * turn;
            bool known = false;
            for (const glm::dquat& q : group) known = known || apart(q, next) < 1e-6;
            if (!known) group.push_back(next);
        }
    return group;
}

/// Random rotations, those of the cube, and those half-way between two of them: ties, half turns, zero components.
std::vector<glm::dquat> sample_rotations(std::size_t count) {
    Random random(count);
    std::vector<glm::dquat> rotations;
    const std::vector<glm::dquat> group = cube_rotations();
    REQUIRE(group.size() == 24);
    for (const glm::dquat& p : group)
        for (const glm::dquat& q : {group[0], group[5], group[11]}) {
            const glm::dquat sum = p + (glm::dot(p, q) < 0 ? -q : q);
            rotations.push_back(glm::normalize(sum));
        }
    while (rotations.size() < count) rotations.push_back(random_rotation(random));
    return rotations;
}

/// The homogeneous quadratic form whose value at a unit quaternion is trace(R^T A).
double form(const glm::dmat3& a, const glm::dvec4& v) {
    const double x = v.x, y = v.y, z = v.z, w = v.w;
    const glm::dmat3 r(w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y), 2 * (x * y - w * z),
                       w * w - x * x + y * y - z * z, 2 * (y * z + w * x), 2 * (x * z + w * y), 2 * (y * z - w * x),
                       w * w - x * x - y * y + z * z);
    return glm::dot(r[0], a[0]) + glm::dot(r[1], a[1]) + glm::dot(r[2], a[2]);
}

/// All stationary values of trace(R^T A) and their rotations, the largest first (Horn 1987): no iteration over
/// rotations.
Eigen<4> horn(const glm::dmat3& a) {
    std::array<std::array<double, 4>, 4> k;
    const auto unit = [](int i) {
        glm::dvec4 e(0);
        e[i] = 1;
        return e;
    };
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) k[i][j] = 0.5 * (form(a, unit(i) + unit(j)) - form(a, unit(i)) - form(a, unit(j)));
    return eigen(k);
}

double largest_entry(const glm::dmat3& m) {
    double largest = 0;
    for (int k = 0; k < 9; ++k) largest = std::max(largest, std::abs(m[k / 3][k % 3]));
    return largest;
}

} // namespace

TEST_CASE("rotation: quaternions of frames and back") {
    std::vector<Floats9> frames;
    std::vector<Floats4> exact, none;
    for (const glm::dquat& q : sample_rotations(small_sizes() ? 96 : 4096)) {
        frames.push_back(columns(glm::mat3_cast(q)));
        exact.push_back(to_float(q));
    }
    none.resize(frames.size());
    const auto quaternions = in_lanes(file, "quaternion_test", none, frames);
    const auto back = in_lanes(file, "frame_test", frames, quaternions);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        CAPTURE(i);
        const glm::dquat q = to_double(quaternions[i]);
        // The rounding of the frame's entries, of four sums of them, and of the normalisation: each at most 2^-24.
        CHECK(std::abs(glm::length(q) - 1) <= 4 * 0x1p-24);
        CHECK(apart(glm::normalize(q), glm::normalize(to_double(exact[i]))) <= 8 * 0x1p-24);
        // An entry has four products of numbers below 1, doubled.
        for (int k = 0; k < 9; ++k) CHECK(std::abs(double(back[i][k]) - frames[i][k]) <= 32 * 0x1p-24);
    }
}

TEST_CASE("rotation: the half-way rotation takes the nearest of the 24 ways to label a box's axes") {
    const std::vector<glm::dquat> group = cube_rotations();
    const std::vector<glm::dquat> rotations = sample_rotations(small_sizes() ? 96 : 2048);
    std::vector<Floats4> first, second, none;
    for (std::size_t i = 0; i < rotations.size(); ++i) {
        first.push_back(to_float(rotations[i]));
        second.push_back(to_float(rotations[(i * 37 + i / 7) % rotations.size()]));
    }
    none.resize(first.size());
    const auto blended = in_lanes(file, "blend_test", none, first, second);
    for (std::size_t i = 0; i < first.size(); ++i) {
        CAPTURE(i);
        const glm::dquat p = to_double(first[i]), q = to_double(second[i]), mine = to_double(blended[i]);
        double best = 0;
        for (const glm::dquat& g : group) best = std::max(best, std::abs(glm::dot(p, q * g)));
        CHECK(std::abs(glm::length(mine) - 1) <= 4 * 0x1p-24);
        // Of those that are nearest, up to the rounding of the comparison, one must be the one that was blended.
        double distance = 2;
        for (const glm::dquat& g : group) {
            const glm::dquat other = q * g;
            const double dot = glm::dot(p, other);
            if (std::abs(dot) < best - 8 * 0x1p-24) continue;
            distance = std::min(distance, apart(mine, glm::normalize(p + (dot < 0 ? -other : other))));
        }
        CHECK(distance <= 16 * 0x1p-24);
    }
}

TEST_CASE("rotation: boxes with the same axes, labelled any way, blend to their own frame") {
    const std::vector<glm::dquat> group = cube_rotations();
    Random random(5);
    std::vector<Floats4> first, second, none;
    for (int n = 0; n < 8; ++n) {
        const glm::dquat q = random_rotation(random);
        for (const glm::dquat& g : group) {
            first.push_back(to_float(q));
            second.push_back(to_float(n % 2 == 0 ? q * g : -(q * g)));
        }
    }
    none.resize(first.size());
    const auto blended = in_lanes(file, "blend_test", none, first, second);
    for (std::size_t i = 0; i < first.size(); ++i)
        CHECK(apart(to_double(blended[i]), to_double(first[i])) <= 8 * 0x1p-24);
}

namespace {

struct Extraction {
    std::vector<Floats9> matrices;
    std::vector<Floats4> starts;
    void add(const glm::dmat3& matrix, const glm::dquat& start) {
        matrices.push_back(columns(matrix));
        starts.push_back(to_float(start));
    }
};

/// Products of rotations and diagonal matrices: any rank, mirrored or not, singular values as far apart as floats tell.
Extraction extraction_cases(int count) {
    Extraction cases;
    Random random(9);
    const glm::dquat half_turns[4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    const glm::dvec3 values[] = {{1, 1, 1},    {1, 1, -1}, {3, 2, 1},    {3, 2, -1},       {1, 1e-3, 1e-3},
                                 {1, 1e-6, 0}, {1, 1, 0},  {1, 0, 0},    {0, 0, 0},        {1, 0.5, -0.5},
                                 {1, 1, 1e-6}, {2, 1, -1}, {-1, -1, -1}, {1, 1e-3, -1e-4}, {5, 5, 4.999}};
    for (const glm::dvec3& v : values) {
        glm::dmat3 d(0);
        for (int k = 0; k < 3; ++k) d[k][k] = v[k];
        // The trap: exact half turns from the end, without and with rounding.
        for (const glm::dquat& turn : half_turns) cases.add(d, turn);
        for (int n = 0; n < count; ++n) {
            const glm::dquat u = random_rotation(random), w = random_rotation(random);
            const glm::dmat3 a = glm::mat3_cast(u) * d * glm::mat3_cast(w);
            for (const glm::dquat& turn : half_turns) cases.add(a, u * w * turn);
            cases.add(a, u * half_turns[n % 3 + 1] * w);
            cases.add(a, random_rotation(random));
        }
    }
    for (int n = 0; n < 50 * count; ++n) {
        glm::dmat3 a;
        for (int k = 0; k < 9; ++k) a[k / 3][k % 3] = random.uniform(-1, 1);
        cases.add(a, random_rotation(random));
    }
    return cases;
}

} // namespace

TEST_CASE("rotation: of any matrix the rotation of largest trace, from any start") {
    const Extraction cases = extraction_cases(small_sizes() ? 1 : 40);
    const auto rotations = in_lanes(file, "extract_test", cases.starts, cases.matrices);
    double worst_trace = 0, worst_angle = 0;
    for (std::size_t i = 0; i < rotations.size(); ++i) {
        CAPTURE(i);
        const glm::dmat3 a = matrix_of(cases.matrices[i]);
        const glm::dquat q = to_double(rotations[i]);
        REQUIRE(std::abs(glm::length(q) - 1) <= 4 * 0x1p-24);
        const Eigen<4> best = horn(a);
        const glm::dvec4 v = glm::dvec4(q.x, q.y, q.z, q.w) / glm::length(q);
        const double size = largest_entry(a);
        // A rotation off by a few roundoffs loses their square times the matrix; what counts is that no other
        // stationary point is taken for the largest.
        const double missing = best.values[0] - form(a, v);
        worst_trace = std::max(worst_trace, size > 0 ? missing / size : 0);
        CHECK(missing <= 64 * 0x1p-24 * size);
        // Where the best is well apart from the rest, the rotation is determined to roundoff times the condition: twice
        // the gap in trace is the curvature.
        const double gap = (best.values[0] - best.values[1]) / 4;
        if (gap < 1e-3 * size || size == 0) continue;
        const auto& e = best.vectors[0];
        const double angle = 2 * apart(glm::normalize(q), glm::dquat(e[3], e[0], e[1], e[2]));
        worst_angle = std::max(worst_angle, angle * gap / size);
        CHECK(angle <= 16 * 0x1p-24 * size / gap + 8 * 0x1p-24);
    }
    MESSAGE("worst loss of trace " << worst_trace * 0x1p24 << " and angle " << worst_angle * 0x1p24
                                   << " roundoffs of the matrix");
}

TEST_CASE("rotation: the size of a matrix does not matter, to the bit") {
    const Extraction cases = extraction_cases(small_sizes() ? 1 : 4);
    const auto expected = in_lanes(file, "extract_test", cases.starts, cases.matrices);
    for (const int exponent : {-60, -20, 1, 60, 120}) {
        CAPTURE(exponent);
        Extraction scaled = cases;
        for (Floats9& matrix : scaled.matrices)
            for (float& value : matrix) value = std::ldexp(value, exponent);
        CHECK(same_bits(in_lanes(file, "extract_test", scaled.starts, scaled.matrices), expected));
    }
    // Denormal: entries keep few digits, but what comes out is a rotation.
    Extraction tiny = cases;
    for (Floats9& matrix : tiny.matrices)
        for (float& value : matrix) value = std::ldexp(value, -140);
    for (const Floats4& q : in_lanes(file, "extract_test", tiny.starts, tiny.matrices))
        CHECK(std::abs(glm::length(to_double(q)) - 1) <= 4 * 0x1p-24);
}

TEST_CASE("rotation: in denormal matrices and in those of the largest floats as in the same at one") {
    Extraction cases = extraction_cases(small_sizes() ? 1 : 4);
    cases.matrices = at_one(cases.matrices);
    const auto extracted = [&](const std::vector<Floats9>& matrices) {
        return in_lanes(file, "extract_test", cases.starts, matrices);
    };
    const auto expected = extracted(cases.matrices);
    for (const int exponent : end_exponents) {
        CAPTURE(exponent);
        CHECK(same_bits(extracted(times_power(cases.matrices, exponent)), expected));
    }
    // FLT_MAX itself.
    for (Floats9& matrix : cases.matrices)
        for (float& entry : matrix) entry = std::copysign(0x1.fffffep0f, entry);
    CHECK(same_bits(extracted(times_power(cases.matrices, 127)), extracted(cases.matrices)));
}
