// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "boxwood/error.hpp"
#include "boxwood/obb.hpp"
#include "oracles/jacobi.hpp"
#include "support.hpp"
#include "tuning.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("bounds");

namespace {

using Points = std::vector<glm::vec3>;

std::vector<Obb> fit(const std::vector<Points>& sets) {
    Device& device = test_device();
    std::vector<float> positions;
    std::vector<std::uint32_t> offsets{0};
    for (const Points& set : sets) {
        for (const glm::vec3& p : set) positions.insert(positions.end(), {p.x, p.y, p.z});
        offsets.push_back(static_cast<std::uint32_t>(positions.size() / 3));
    }
    const Guarded<Obb> boxes(device, sets.size());
    fit_obbs(device, upload(device, positions, "points"), upload(device, offsets, "offsets"), boxes.view());
    CHECK(boxes.intact());
    return boxes.values();
}

Obb fit(const Points& set) { return fit(std::vector<Points>{set})[0]; }

/// Finite, every point inside, axes right-handed and orthonormal to what eigenvectors() gives (see eigen_test.cpp).
void check_valid(const Obb& box, const Points& points) {
    for (int k = 0; k < 3; ++k) {
        CHECK(std::isfinite(box.center[k]));
        CHECK(std::isfinite(box.extent[k]));
        CHECK(box.extent[k] >= 0);
    }
    glm::dmat3 axes;
    for (int k = 0; k < 9; ++k) axes[k / 3][k % 3] = box.axes[k];
    const glm::dmat3 square = glm::transpose(axes) * axes;
    for (int k = 0; k < 9; ++k) CHECK(std::abs(square[k / 3][k % 3] - (k % 4 == 0 ? 1 : 0)) <= 24 * 0x1p-24);
    CHECK(glm::determinant(axes) > 0);
    std::size_t outside = 0;
    for (const glm::vec3& p : points) outside += contains(box, glm::dvec3(p)) ? 0 : 1;
    CHECK(outside == 0);
}

struct Reference {
    double volume, area;
    double gap; ///< Smallest difference of eigenvalues, relative to the largest.
};

/// Principal component analysis in double precision, about the mean.
Reference reference(const Points& points) {
    glm::dvec3 mean(0);
    for (const glm::vec3& p : points) mean += glm::dvec3(p) / double(points.size());
    std::array<std::array<double, 3>, 3> m{};
    for (const glm::vec3& p : points) {
        const glm::dvec3 d = glm::dvec3(p) - mean;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) m[i][j] += d[i] * d[j] / double(points.size());
    }
    const Eigen<3> e = eigen(m);
    glm::dvec3 width;
    for (int k = 0; k < 3; ++k) {
        double low = INFINITY, high = -INFINITY;
        for (const glm::vec3& p : points) {
            const double t =
                glm::dot(glm::dvec3(e.vectors[k][0], e.vectors[k][1], e.vectors[k][2]), glm::dvec3(p) - mean);
            low = std::min(low, t);
            high = std::max(high, t);
        }
        width[k] = high - low;
    }
    const double gap = std::min(e.values[0] - e.values[1], e.values[1] - e.values[2]) / e.values[0];
    return {width.x * width.y * width.z, 2 * (width.x * width.y + width.y * width.z + width.z * width.x), gap};
}

glm::dmat3 some_rotation(std::uint64_t salt) {
    Random random(salt);
    const auto next = [&] { return random.uniform(-1, 1); };
    return glm::mat3_cast(glm::normalize(glm::dquat(next(), next(), next(), next() + 1.5)));
}

Points map(const Points& points, const glm::dmat3& linear, const glm::dvec3& shift = glm::dvec3(0)) {
    Points result;
    for (const glm::vec3& p : points) result.push_back(glm::vec3(linear * glm::dvec3(p) + shift));
    return result;
}

Points cloud(std::size_t count, const glm::dvec3& size, std::uint64_t salt) {
    Random random(salt);
    Points points;
    for (std::size_t i = 0; i < count; ++i)
        points.push_back(
            glm::vec3(size * glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1))));
    return points;
}

/// The corners of [-1, 1]^3, or a grid of n x n on each of its faces.
Points cube(int n = 1) {
    Points points;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j)
            for (int k = 0; k <= n; ++k)
                if (i % n == 0 || j % n == 0 || k % n == 0)
                    points.push_back(glm::vec3(2 * i - n, 2 * j - n, 2 * k - n) / float(n));
    return points;
}

const Points tetrahedron = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};

} // namespace

TEST_CASE("fit_obb: none, one, two and three points, and empty segments between them") {
    CHECK(fit(std::vector<Points>{}).empty());
    const std::vector<Points> sets = {{}, {{1, 2, 3}}, {}, {{0, 0, 0}, {1, 2, 2}}, {{0, 0, 0}, {4, 0, 0}, {0, 1, 0}},
                                      {}};
    const std::vector<Obb> boxes = fit(sets);
    for (const std::size_t empty : {0, 2, 5}) {
        CHECK(boxes[empty].extent[0] == -INFINITY);
        CHECK(volume(boxes[empty]) == 0);
    }
    for (const std::size_t i : {1, 3, 4}) check_valid(boxes[i], sets[i]);
    for (int k = 0; k < 3; ++k) CHECK(boxes[1].extent[k] <= 16 * 0x1p-24 * 3);
    CHECK(boxes[3].extent[0] == doctest::Approx(1.5).epsilon(1e-6)); // half the distance of (0, 0, 0) and (1, 2, 2)
    CHECK(boxes[3].extent[1] <= 16 * 0x1p-24 * 3);
    CHECK(boxes[4].extent[2] <= 16 * 0x1p-24 * 4);
    CHECK(fit(std::vector<Points>(3)).size() == 3); // no points at all
}

TEST_CASE("fit_obb: identical, collinear and coplanar points") {
    const Points same(100, glm::vec3(0.1f, -7, 1e5f));
    const Obb point = fit(same);
    check_valid(point, same);
    for (const float extent : point.extent) CHECK(extent <= 16 * 0x1p-24 * 1e5);

    Points line, plane;
    for (int i = 0; i < 100; ++i) line.push_back(glm::vec3(glm::dvec3(3, -1, 2) + 0.01 * i * glm::dvec3(2, 3, 6)));
    const Obb stick = fit(line);
    check_valid(stick, line);
    CHECK(stick.extent[0] == doctest::Approx(0.01 * 99 * 7 / 2).epsilon(1e-6));
    CHECK(stick.extent[1] <= 16 * 0x1p-24 * 10); // the points are rounded themselves
    CHECK(stick.extent[2] <= 16 * 0x1p-24 * 10);

    plane = map(cloud(500, {3, 1, 0}, 1), some_rotation(2));
    const Obb sheet = fit(plane);
    check_valid(sheet, plane);
    CHECK(sheet.extent[2] <= 16 * 0x1p-24 * 4);
}

TEST_CASE("fit_obb: clouds against double precision, any size, anywhere") {
    struct Place {
        double size, offset;
    };
    // At 1e7 a step of float is 1: the points are what they are after rounding, and so is the reference.
    for (const Place& place : {Place{1, 0}, {1e-30, 0}, {1e18, 0}, {1e3, 1e7}, {1e-3, 10}}) {
        CAPTURE(place.size);
        CAPTURE(place.offset);
        for (int n = 0; n < 4; ++n) {
            const Points points = map(cloud(n == 0 ? 50 : 3000, {3, 2, 1}, n), place.size * some_rotation(n),
                                      glm::dvec3(place.offset, -place.offset, place.offset / 2));
            const Obb box = fit(points);
            check_valid(box, points);
            const Reference exact = reference(points);
            REQUIRE(exact.gap > 0.05);
            // Roundoff turns the axes by at most a few of it over the gap; the width of a box changes by the sine of
            // the turn times the others. The step of the centre's grid adds to each width.
            const double step = 3 * 0x1p-24 * place.offset / place.size;
            const double bound = 256 * 0x1p-24 / exact.gap + 8 * step;
            CHECK(volume(box) == doctest::Approx(exact.volume).epsilon(bound));
            CHECK(surface_area(box) == doctest::Approx(exact.area).epsilon(bound));
        }
    }
}

TEST_CASE("fit_obb: needles") {
    for (int n = 0; n < 5; ++n) {
        const Points points = map(cloud(200, {1, 1e-6, 1e-6}, n), some_rotation(n + 10));
        const Obb box = fit(points);
        check_valid(box, points);
        // Widths of a square of 1e-6, and roundoffs of the length: of the points themselves, of the axes, and padding.
        const double thin = std::sqrt(2.0) * 1e-6 + 32 * 0x1p-24;
        CHECK(box.extent[0] <= 1 + thin);
        CHECK(box.extent[1] <= thin);
        CHECK(box.extent[2] <= thin);
    }
}

TEST_CASE("fit_obb: a few points far from the many that decide the mean") {
    // All but two of 100,002 points within 1e-4 of a corner of the box: what is summed about its centre would cancel.
    const std::size_t count = small_sizes() ? 1000 : 100000;
    Points points = map(cloud(count, {3e-4, 2e-4, 1e-4}, 7), some_rotation(7));
    points.push_back({1, 1, 1});
    points.push_back({1.0f, 1.0f, 1.001f});
    const Obb box = fit(points);
    check_valid(box, points);
    const Reference exact = reference(points);
    CHECK(volume(box) <= exact.volume * (1 + 1e-2));
}

TEST_CASE("fit_obb: rotated cubes come out as cubes, though their covariance has no axes") {
    std::vector<Points> sets;
    for (int n = 0; n < 40; ++n) sets.push_back(map(cube(n % 2 == 0 ? 1 : 4), 50.0 * some_rotation(n)));
    for (const double degrees : {0.0, 15.0, 45.0, 90.0})
        for (const glm::dvec3& axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 1), glm::dvec3(1, 1, 1)})
            for (const int n : {1, 4})
                sets.push_back(
                    map(cube(n), 50.0 * glm::dmat3(glm::rotate(glm::dmat4(1), glm::radians(degrees), axis))));
    const std::vector<Obb> boxes = fit(sets);
    for (std::size_t i = 0; i < sets.size(); ++i) {
        CAPTURE(i);
        check_valid(boxes[i], sets[i]);
        for (const float extent : boxes[i].extent) CHECK(std::abs(extent - 50) <= 1e-4);
    }
}

TEST_CASE("fit_obb: sphere, tetrahedron, square, and points as a cube's") {
    Points sphere;
    for (int i = 0; i < 2000; ++i) { // Fibonacci's
        const double z = 1 - (2 * i + 1) / 2000.0, r = std::sqrt(1 - z * z), t = i * 2.399963229728653;
        sphere.push_back(glm::vec3(r * std::cos(t), r * std::sin(t), z));
    }
    const Obb ball = fit(sphere);
    check_valid(ball, sphere);
    CHECK(volume(ball) <= 8 * (1 + 1e-5));

    for (int n = 0; n < 20; ++n) {
        CAPTURE(n);
        const Points points = map(tetrahedron, some_rotation(n));
        const Obb box = fit(points);
        check_valid(box, points);
        CHECK(volume(box) <= 8 * (1 + 1e-5)); // that of the cube it is inscribed in, the smallest

        const Points square = map({{1, 1, 0}, {1, -1, 0}, {-1, 1, 0}, {-1, -1, 0}}, some_rotation(n));
        const Obb flat = fit(square);
        check_valid(flat, square);
        CHECK(surface_area(flat) <= 8 * (1 + 1e-5));

        // Never worse than plain principal axes.
        const Points even = map(cloud(300, {1, 1, 1}, n), some_rotation(n));
        const Obb any = fit(even);
        check_valid(any, even);
        CHECK(surface_area(any) <= reference(even).area * (1 + 1e-5));
    }
}

TEST_CASE("fit_obb: denormals and sizes far apart") {
    const Points denormals = map(cloud(100, {3, 2, 1}, 1), 0x1p-140 * some_rotation(1));
    check_valid(fit(denormals), denormals);
    const Points one_step = {{0, 0, 0}, {0x1p-149f, 0, 0}, {0, 0x1p-149f, 0}};
    check_valid(fit(one_step), one_step);
    const Points apart = {{0, 0, 0}, {1024, 0, 0}, {1024, 0x1p-139f, 0}, {0, 0, 0x1p-140f}};
    check_valid(fit(apart), apart);
    const Points wide = {{-1e18f, 0, 0}, {1e18f, 0, 0}, {0, 1e-30f, 0}, {0, 0, 1e-38f}};
    check_valid(fit(wide), wide);
}

TEST_CASE("fit_obb: a set scaled by a power of two has the same axes, to the bit") {
    std::vector<Points> sets = {map(cube(), some_rotation(3)), map(cloud(1500, {3, 2, 1}, 1), some_rotation(4))};
    const std::vector<Obb> expected = fit(sets);
    for (const int exponent : {-40, -1, 13, 40}) {
        CAPTURE(exponent);
        std::vector<Points> scaled = sets;
        for (Points& set : scaled)
            for (glm::vec3& p : set) p *= std::ldexp(1.0f, exponent);
        const std::vector<Obb> boxes = fit(scaled);
        for (std::size_t i = 0; i < sets.size(); ++i)
            CHECK(std::equal(boxes[i].axes, boxes[i].axes + 9, expected[i].axes));
    }
}

TEST_CASE("fit_obb: many segments, cut any way, give the same bytes") {
    Random random(11);
    std::vector<Points> sets;
    // Segments within, across and over many tiles of 1024.
    for (const std::uint32_t longest : {1, 3, 40, 900, 5000, 40000}) {
        if (small_sizes() && longest > 900) break;
        for (int n = 0; n < 8; ++n)
            sets.push_back(map(cloud(random.below(longest + 1), {1, n % 2 ? 1 : 0.5, 0.3}, n), some_rotation(n)));
    }
    std::vector<std::vector<Obb>> results;
    for (const Tuning& tuning : tunings()) {
        const TuningScope scope(tuning);
        results.push_back(fit(sets));
    }
    for (const auto& result : results) CHECK(same_bits(result, results[0]));
    for (std::size_t i = 0; i < sets.size(); ++i)
        if (!sets[i].empty()) check_valid(results[0][i], sets[i]);
    CHECK_THROWS_AS(fit_obbs(test_device(), make_buffer<float>(test_device(), 3, "points").view(),
                             make_buffer<std::uint32_t>(test_device(), 2, "offsets").view(),
                             make_buffer<Obb>(test_device(), 2, "boxes").view()),
                    InputError);
}

namespace {

std::vector<Obb> fit_meshes(const Scene& scene) {
    Device& device = test_device();
    const Geometry geometry = upload(device, scene);
    const Guarded<Obb> boxes(device, scene.meshes.size());
    fit_mesh_obbs(device, geometry, boxes.view());
    CHECK(boxes.intact());
    return boxes.values();
}

/// A box of half sizes 3, 2, 1 whose faces are cut into n x n squares, but the one at +x into 8n x 8n.
Mesh cut_box(int n, const glm::dmat3& rotation) {
    Mesh mesh;
    for (int face = 0; face < 6; ++face) {
        const int k = face / 2, u = (k + 1) % 3, v = (k + 2) % 3, m = face == 0 ? 8 * n : n;
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (int i = 0; i <= m; ++i)
            for (int j = 0; j <= m; ++j) {
                glm::dvec3 p;
                p[k] = face % 2 ? -1 : 1;
                p[u] = 2.0 * i / m - 1;
                p[v] = 2.0 * j / m - 1;
                mesh.positions.push_back(glm::vec3(rotation * (p * glm::dvec3(3, 2, 1))));
                if (i == m || j == m) continue;
                const std::uint32_t a = first + i * (m + 1) + j, b = a + m + 1;
                mesh.triangles.push_back({a, a + 1, b});
                mesh.triangles.push_back({b, a + 1, b + 1});
            }
    }
    return mesh;
}

} // namespace

TEST_CASE("fit_obb: fit_mesh_obbs: a box comes out whatever its faces are cut into") {
    Scene scene;
    for (int n = 1; n <= 6; ++n) scene.meshes.push_back(cut_box(n, some_rotation(n)));
    const std::vector<Obb> boxes = fit_meshes(scene);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        CAPTURE(i);
        check_valid(boxes[i], scene.meshes[i].positions);
        // The eigenvalues of the surface's covariance are at least 0.1 of the largest apart: the axes are off by some
        // roundoffs times ten, and a width by three of another.
        CHECK(volume(boxes[i]) == doctest::Approx(48).epsilon(1e-4));
        CHECK(boxes[i].extent[0] == doctest::Approx(3).epsilon(1e-4));
        CHECK(boxes[i].extent[2] == doctest::Approx(1).epsilon(1e-4));
        // Points alone are misled by the dense face.
        if (i == 5) CHECK(volume(fit(scene.meshes[i].positions)) >= 48 * (1 - 1e-5));
    }
}

TEST_CASE("fit_obb: fit_mesh_obbs: meshes without area, of one triangle, and none") {
    CHECK(fit_meshes(Scene{}).empty());
    Scene scene;
    scene.meshes.push_back({"triangle", {{0, 0, 0}, {4, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
    scene.meshes.push_back({"segment", {{1, 1, 1}, {2, 3, 3}, {1.5f, 2, 2}}, {{0, 1, 2}}});
    scene.meshes.push_back({"point", {{5, 6, 7}, {5, 6, 7}, {5, 6, 7}}, {{0, 1, 2}}});
    scene.meshes.push_back({"points", {{0, 0, 0}, {1, 2, 2}}, {{0, 0, 0}, {1, 1, 1}}});
    const std::vector<Obb> boxes = fit_meshes(scene);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        CAPTURE(i);
        check_valid(boxes[i], scene.meshes[i].positions);
    }
    CHECK(boxes[0].extent[2] <= 16 * 0x1p-24 * 4);
    CHECK(boxes[1].extent[0] == doctest::Approx(1.5).epsilon(1e-6));
    CHECK(boxes[1].extent[1] <= 16 * 0x1p-24 * 4);
    for (const float extent : boxes[2].extent) CHECK(extent <= 16 * 0x1p-24 * 8);
    CHECK(boxes[3].extent[0] == doctest::Approx(1.5).epsilon(1e-6));
    CHECK(boxes[3].extent[1] <= 16 * 0x1p-24 * 4);
}
