// SPDX-License-Identifier: MIT
#include "oracles/extreme_rays.hpp"

#include <bit>
#include <cmath>
#include <limits>

#include "oracles/generator.hpp"

namespace boxwood::test {

namespace {

Ray ray_from(const glm::vec3& origin, const glm::vec3& direction) {
    return {{origin.x, origin.y, origin.z},
            0.0f,
            {direction.x, direction.y, direction.z},
            std::numeric_limits<float>::infinity()};
}

void place(Mesh mesh, ExtremeRays& made) {
    made.scene.meshes.push_back(std::move(mesh));
    made.scene.instances.push_back({"", 0, glm::mat4(1.0f)});
}

} // namespace

ExtremeRays sliver_rays(float aspect, std::uint32_t triangles, std::size_t rays, std::uint64_t seed) {
    Generator random(seed);
    ExtremeRays made{"slivers, " + std::to_string(static_cast<int>(aspect)) + ":1, grazed", {}, {}};
    Mesh mesh;
    struct Place {
        glm::vec3 middle, along, across;
    };
    std::vector<Place> places;
    for (std::uint32_t i = 0; i < triangles; ++i) {
        const glm::vec3 middle = 3.0f * random.direction(), along = random.direction();
        const glm::vec3 across = glm::normalize(glm::cross(along, random.direction()));
        places.push_back({middle, along, across});
        for (const glm::vec3& p : {middle - along, middle + along, middle + across / aspect})
            mesh.positions.push_back(p);
        mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    for (std::size_t i = 0; i < rays; ++i) {
        const auto& [middle, along, across] = places[random.below(triangles)];
        const float angle = std::pow(10.0f, random.uniform(-6, -3)), away = std::pow(10.0f, random.uniform(0, 6));
        const glm::vec3 target = middle + random.uniform(-0.5f, 0.5f) * along + across * (0.2f / aspect);
        const glm::vec3 from = along + angle * glm::cross(along, across) + random.uniform(-1, 1) * across / aspect;
        made.rays.push_back(ray_from(target + away * from, -from));
    }
    place(std::move(mesh), made);
    return made;
}

ExtremeRays random_bit_rays(std::uint32_t triangles, std::size_t rays, std::uint64_t seed) {
    Generator random(seed);
    ExtremeRays made{"triangles of random bits", {}, {}};
    Mesh mesh;
    const auto coordinate = [&] {
        while (true) {
            const float x = std::bit_cast<float>(static_cast<std::uint32_t>(random.bits() >> 32));
            if (std::fabs(x) < 0x1p59f) return x;
        }
    };
    const auto point = [&] {
        const float x = coordinate(), y = coordinate();
        return glm::vec3(x, y, coordinate());
    };
    for (std::uint32_t i = 0; i < triangles; ++i) {
        for (int k = 0; k < 3; ++k) mesh.positions.push_back(point());
        mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    for (std::size_t i = 0; i < rays; ++i) {
        const glm::vec3* p = &mesh.positions[3 * random.below(triangles)];
        const glm::vec3 middle = p[0] / 3.0f + p[1] / 3.0f + p[2] / 3.0f, away = random.direction();
        const glm::vec3 origin = i % 2 == 0 ? middle + away * std::fabs(coordinate()) : point();
        made.rays.push_back(ray_from(origin, i % 3 == 0 ? random.direction() : middle - origin));
    }
    place(std::move(mesh), made);
    return made;
}

} // namespace boxwood::test
