// SPDX-License-Identifier: MIT
#include "oracles/extreme_meshes.hpp"

#include <cmath>
#include <functional>
#include <random>

namespace boxwood::test {

namespace {

using Generator = std::mt19937_64;

float uniform(Generator& random, float low, float high) {
    return low + (high - low) * static_cast<float>(random() >> 40) * 0x1p-24f;
}

Mesh triangles_of(const std::vector<glm::vec3>& corners) {
    Mesh mesh;
    mesh.positions = corners;
    for (std::uint32_t i = 0; i + 2 < corners.size(); i += 3) mesh.triangles.push_back({i, i + 1, i + 2});
    return mesh;
}

/// Random triangles whose corners `place` puts somewhere.
Mesh placed(std::size_t triangles, std::uint64_t seed, const std::function<glm::vec3(Generator&)>& place) {
    Generator random(seed);
    std::vector<glm::vec3> corners;
    for (std::size_t i = 0; i < 3 * triangles; ++i) corners.push_back(place(random));
    return triangles_of(corners);
}

glm::vec3 in_cube(Generator& random) {
    const float x = uniform(random, -1, 1), y = uniform(random, -1, 1), z = uniform(random, -1, 1);
    return {x, y, z};
}

/// All but the last triangle within a millionth of one place, which the Morton codes do not tell apart.
Mesh equal_codes(std::size_t triangles, std::uint64_t seed) {
    Mesh mesh = placed(triangles, seed, [](Generator& r) { return glm::vec3(1.0f) + 1e-6f * in_cube(r); });
    mesh.positions.push_back(glm::vec3(-1e3f));
    mesh.triangles.back().z = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    return mesh;
}

/// Each triangle half as far from the origin as the one before: the tree is a chain, as deep as its keys have bits.
Mesh chain(std::size_t triangles) {
    std::vector<glm::vec3> corners;
    float size = 1.0f;
    for (std::size_t i = 0; i<triangles; ++i, size = size> 1e-36f ? 0.5f * size : 1.0f) {
        corners.insert(corners.end(), {glm::vec3(size, 0.9f * size, 0.7f * size), glm::vec3(size, size, 0.8f * size),
                                       glm::vec3(0.9f * size, size, size)});
    }
    return triangles_of(corners);
}

} // namespace

Mesh cube_of_triangles(std::size_t triangles, std::uint64_t seed) { return placed(triangles, seed, in_cube); }

Mesh turned_cube(std::uint32_t n) {
    const glm::dvec3 a(0.36, 0.48, -0.8), b(-0.8, 0.6, 0.0), c = glm::cross(a, b);
    std::vector<glm::vec3> corners;
    const auto at = [&](int axis, double side, double u, double v) {
        glm::dvec3 p;
        p[axis] = side;
        p[(axis + 1) % 3] = u;
        p[(axis + 2) % 3] = v;
        return glm::vec3(50.0 * (p.x * a + p.y * b + p.z * c));
    };
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0})
            for (std::uint32_t i = 0; i < n; ++i)
                for (std::uint32_t j = 0; j < n; ++j) {
                    const double u = 2.0 * i / n - 1, v = 2.0 * j / n - 1, s = 2.0 / n;
                    const glm::vec3 p = at(axis, side, u, v), q = at(axis, side, u + s, v),
                                    r = at(axis, side, u + s, v + s), t = at(axis, side, u, v + s);
                    corners.insert(corners.end(), {p, q, r, p, r, t});
                }
    return triangles_of(corners);
}

std::vector<ExtremeMesh> extreme_meshes(std::size_t triangles, std::uint64_t seed) {
    const glm::vec3 along(1.0f, 0.7f, -0.3f), across(0.2f, -0.5f, 0.9f);
    const auto squares = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(triangles) / 12.0)) + 1;
    std::vector<ExtremeMesh> list;
    const auto add = [&](const char* words, const std::function<glm::vec3(Generator&)>& place) {
        list.push_back({words, placed(triangles, seed + list.size(), place)});
    };
    add("ordinary", in_cube);
    add("one point", [](Generator&) { return glm::vec3(3, -5, 7); });
    add("one point at the origin", [](Generator&) { return glm::vec3(0); });
    add("collinear", [&](Generator& r) { return uniform(r, -1, 1) * along; });
    add("coplanar", [&](Generator& r) {
        const float u = uniform(r, -1, 1), v = uniform(r, -1, 1);
        return u * along + v * across;
    });
    add("needles 1e6:1", [&](Generator& r) {
        const float u = uniform(r, -1, 1);
        return u * along + 1e-6f * in_cube(r);
    });
    add("covariance diag(2000, 1, 0)", [](Generator& r) { return glm::vec3(44.7f, 1.0f, 0.0f) * in_cube(r); });
    add("coordinates of 1e-30", [](Generator& r) { return 1e-30f * in_cube(r); });
    add("coordinates of 1e18", [](Generator& r) { return 1e18f * in_cube(r); });
    add("features of 1e-3 at 1e3", [](Generator& r) { return glm::vec3(1e3f, -1e3f, 1e3f) + 1e-3f * in_cube(r); });
    add("features of 1e-3 at 1e7", [](Generator& r) { return glm::vec3(1e7f, -1e7f, 1e7f) + 1e-3f * in_cube(r); });
    add("denormals", [](Generator& r) { return 1e-41f * in_cube(r); });
    add("sizes from 1e-38 to 1e18",
        [](Generator& r) { return std::ldexp(1.0f, static_cast<int>(r() % 186) - 126) * in_cube(r); });
    list.push_back({"equal Morton codes", equal_codes(triangles, seed)});
    list.push_back({"chain", chain(triangles)});
    list.push_back({"turned cube", turned_cube(squares)});
    return list;
}

} // namespace boxwood::test
