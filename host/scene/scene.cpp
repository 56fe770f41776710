// SPDX-License-Identifier: MIT
#include "boxwood/scene.hpp"

#include "boxwood/error.hpp"
#include "scene/transform.hpp"

namespace boxwood {

namespace {

constexpr std::uint64_t triangle_limit = std::uint64_t{1} << 31;

} // namespace

std::uint64_t Scene::triangle_count() const {
    std::uint64_t count = 0;
    for (const Mesh& mesh : meshes) count += mesh.triangles.size();
    return count;
}

std::uint64_t Scene::instanced_triangle_count() const {
    std::uint64_t count = 0;
    for (const Instance& instance : instances) count += meshes[instance.mesh].triangles.size();
    return count;
}

std::uint64_t Scene::vertex_count() const {
    std::uint64_t count = 0;
    for (const Mesh& mesh : meshes) count += mesh.positions.size();
    return count;
}

Scene flatten(const Scene& scene) {
    Scene flat;
    flat.cameras = scene.cameras;
    flat.counts = scene.counts;
    flat.warnings = scene.warnings;
    if (scene.instances.empty()) return flat;

    const std::uint64_t triangles = scene.instanced_triangle_count();
    if (triangles >= triangle_limit)
        throw CapacityError("triangles of a flattened scene", triangles, triangle_limit - 1);
    std::uint64_t vertices = 0;
    for (const Instance& instance : scene.instances) vertices += scene.meshes[instance.mesh].positions.size();
    constexpr std::uint64_t vertex_limit = std::uint64_t{1} << 32;
    if (vertices > vertex_limit) throw CapacityError("vertices of a flattened scene", vertices, vertex_limit);

    Mesh merged{"flattened", {}, {}};
    merged.positions.reserve(vertices);
    merged.triangles.reserve(triangles);
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        const auto base = static_cast<std::uint32_t>(merged.positions.size());
        append_transformed(mesh.positions, instance.transform, merged.positions);
        for (const glm::uvec3& triangle : mesh.triangles) merged.triangles.push_back(triangle + base);
    }
    flat.meshes.push_back(std::move(merged));
    flat.instances.push_back({"flattened", 0, glm::mat4(1.0f)});
    return flat;
}

} // namespace boxwood
