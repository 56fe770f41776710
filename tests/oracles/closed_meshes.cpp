// SPDX-License-Identifier: MIT
#include "oracles/closed_meshes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "oracles/generator.hpp"

namespace boxwood::test {

namespace {

Mesh sphere(const ClosedKind& kind) {
    Mesh mesh;
    const auto add = [&](const glm::dvec3& unit) {
        mesh.positions.emplace_back(kind.radii * unit + (kind.instances ? glm::dvec3(0.0) : kind.center));
    };
    add({0, 1, 0});
    for (std::uint32_t stack = 1; stack < kind.stacks; ++stack)
        for (std::uint32_t slice = 0; slice < kind.slices; ++slice) {
            const double polar = std::numbers::pi * stack / kind.stacks;
            const double around = 2.0 * std::numbers::pi * slice / kind.slices;
            add({std::sin(polar) * std::cos(around), std::cos(polar), std::sin(polar) * std::sin(around)});
        }
    add({0, -1, 0});
    const auto last = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    const auto vertex = [&](std::uint32_t stack, std::uint32_t slice) {
        if (stack == 0) return 0u;
        return stack == kind.stacks ? last : 1 + (stack - 1) * kind.slices + slice % kind.slices;
    };
    for (std::uint32_t stack = 0; stack < kind.stacks; ++stack)
        for (std::uint32_t slice = 0; slice < kind.slices; ++slice) {
            const std::uint32_t a = vertex(stack, slice), b = vertex(stack, slice + 1), c = vertex(stack + 1, slice),
                                d = vertex(stack + 1, slice + 1);
            if (stack > 0) mesh.triangles.emplace_back(a, b, d);
            if (stack + 1 < kind.stacks) mesh.triangles.emplace_back(a, d, c);
        }
    return mesh;
}

std::array<glm::dvec3, 3> world_triangle(const ClosedScene& closed, std::size_t index) {
    const Instance& instance = closed.scene.instances.front();
    const Mesh& mesh = closed.scene.meshes[instance.mesh];
    const glm::uvec3 triangle = mesh.triangles[index];
    std::array<glm::dvec3, 3> corners;
    for (int k = 0; k < 3; ++k)
        corners[static_cast<std::size_t>(k)] =
            glm::dvec3(glm::dmat4(instance.transform) * glm::dvec4(glm::dvec3(mesh.positions[triangle[k]]), 1.0));
    return corners;
}

/// The direction of a ray from `origin`.
glm::vec3 aimed(const ClosedScene& closed, Aim aim, const glm::vec3& origin, Generator& random) {
    const Mesh& mesh = closed.scene.meshes[closed.scene.instances.front().mesh];
    const auto corners = world_triangle(closed, random.below(mesh.triangles.size()));
    const std::size_t first = random.below(3), second = (first + 1) % 3;
    const auto towards = [&](const glm::dvec3& p) { return glm::vec3(p - glm::dvec3(origin)); };
    switch (aim) {
    case Aim::edges:
    case Aim::from_center:
        if (aim == Aim::from_center && random.below(2) == 0) return towards(corners[first]);
        return towards(glm::mix(corners[first], corners[second], random.unit()));
    case Aim::vertices:
        return towards(corners[first]);
    case Aim::along_edges:
        return glm::vec3(corners[second] - corners[first]);
    case Aim::axes: {
        glm::vec3 direction = random.cube();
        const float zero = random.below(2) == 0 ? 0.0f : -0.0f;
        const int axis = static_cast<int>(random.below(3));
        direction[axis] = zero;
        if (random.below(2) == 0) direction[(axis + 1) % 3] = -zero;
        return direction;
    }
    case Aim::anywhere:
        break;
    }
    return random.cube();
}

} // namespace

std::vector<ClosedKind> closed_kinds() {
    const glm::dvec3 far(148376.0, 1234.0, -223423.0);
    return {{"960 triangles", 16, 32},
            {"65,024 triangles", 128, 256},
            {"640,000 triangles", 401, 800},
            {"4,900 triangles, turned, stretched, mirrored", 50, 50, glm::dvec3(1.0), glm::dvec3(0.0), true},
            {"960 triangles, 1e4:1", 16, 32, {1e4, 1.0, 1.0}},
            {"65,024 triangles, 1:1e4", 128, 256, {1.0, 1e-4, 1.0}},
            {"960 triangles of radius 2, far away", 16, 32, glm::dvec3(2.0), far},
            {"65,024 triangles of radius 2, far away", 128, 256, glm::dvec3(2.0), far},
            {"4,900 triangles of radius 2, turned, far away", 50, 50, glm::dvec3(2.0), far, true},
            {"960 triangles of radius 1,000 at 1e7", 16, 32, glm::dvec3(1e3), glm::dvec3(1e7)},
            {"65,024 triangles of radius 1e5 at 1e7", 128, 256, glm::dvec3(1e5), glm::dvec3(1e7)}};
}

ClosedScene make_closed(const ClosedKind& kind) {
    ClosedScene closed;
    closed.inside = kind.center;
    closed.room = 0.1 * std::min({kind.radii.x, kind.radii.y, kind.radii.z});
    closed.scene.meshes.push_back(sphere(kind));
    if (!kind.instances) {
        closed.scene.instances.push_back({"", 0, glm::mat4(1.0f)});
        return closed;
    }
    for (int i = 0; i < 4; ++i) {
        glm::dmat4 place = glm::translate(glm::dmat4(1.0), kind.center);
        if (i > 0) place = glm::rotate(place, 0.7 * i, glm::normalize(glm::dvec3(1, i, 2 - i)));
        if (i > 0) place = glm::scale(place, {1.0 + 0.5 * i, i == 2 ? -1.0 : 1.0, i == 3 ? 1e3 : 1.0});
        closed.scene.instances.push_back({"", 0, glm::mat4(place)});
    }
    return closed;
}

std::vector<Ray> rays_from_inside(const ClosedScene& closed, Aim aim, std::size_t count, std::uint64_t seed) {
    Generator random(seed);
    std::vector<Ray> rays(count);
    for (Ray& ray : rays) {
        const glm::dvec3 offset = aim == Aim::from_center ? glm::dvec3(0.0) : closed.room * random.cube();
        const glm::vec3 origin(closed.inside + offset);
        glm::vec3 direction(0.0f);
        while (direction == glm::vec3(0.0f)) direction = aimed(closed, aim, origin, random);
        ray = {{origin.x, origin.y, origin.z},
               0.0f,
               {direction.x, direction.y, direction.z},
               std::numeric_limits<float>::infinity()};
    }
    return rays;
}

} // namespace boxwood::test
