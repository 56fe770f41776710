// SPDX-License-Identifier: MIT
#include "boxwood/scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "boxwood/error.hpp"
#include "scene/transform.hpp"

namespace boxwood {

namespace {

constexpr std::uint64_t triangle_limit = std::uint64_t{1} << 31;

std::string element(const char* array, std::size_t index) {
    return std::string(array) + "[" + std::to_string(index) + "]";
}

void validate_mesh(const Mesh& mesh, const std::string& file, const std::string& where) {
    if (mesh.triangles.empty()) throw InputError(file, where + ".triangles", "has no triangle");
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        if (!in_range(mesh.positions[i])) {
            throw InputError(file, where + "." + element("positions", i), "is not finite or out of range");
        }
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::uvec3& triangle = mesh.triangles[i];
        if (std::max({triangle.x, triangle.y, triangle.z}) >= mesh.positions.size()) {
            throw InputError(file, where + "." + element("triangles", i), "names a vertex that does not exist");
        }
    }
}

void validate_instance(const Scene& scene, std::size_t index, const std::vector<MeshBounds>& bounds,
                       const std::string& file) {
    const Instance& instance = scene.instances[index];
    if (instance.mesh >= scene.meshes.size()) {
        throw InputError(file, element("instances", index) + ".mesh", "names a mesh that does not exist");
    }
    const std::string_view fault = placement_fault(instance.transform, bounds[instance.mesh]);
    if (!fault.empty()) throw InputError(file, element("instances", index) + ".transform", std::string(fault));
}

void validate_camera(const Camera& camera, const std::string& file, const std::string& where) {
    const std::string_view fault = transform_fault(camera.to_world);
    if (!fault.empty()) throw InputError(file, where + ".to_world", std::string(fault));
    if (camera.perspective && !(camera.vertical_fov > 0.0f && camera.vertical_fov < std::numbers::pi_v<float>)) {
        throw InputError(file, where + ".vertical_fov", "is not between 0 and pi");
    }
    if (!camera.perspective && !(camera.half_height > 0.0f && std::isfinite(camera.half_height))) {
        throw InputError(file, where + ".half_height", "is not positive and finite");
    }
}

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

void validate(const Scene& scene, const std::string& file) {
    std::vector<MeshBounds> bounds;
    bounds.reserve(scene.meshes.size());
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        validate_mesh(scene.meshes[i], file, element("meshes", i));
        bounds.push_back(mesh_bounds(scene.meshes[i].positions));
    }
    for (std::size_t i = 0; i < scene.instances.size(); ++i) validate_instance(scene, i, bounds, file);
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        validate_camera(scene.cameras[i], file, element("cameras", i));
    }
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
