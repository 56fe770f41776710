// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>

#include "boxwood/error.hpp"
#include "boxwood/scene.hpp"
#include "scene/transform.hpp"
#include "scene/validate_camera.hpp"
#include "scene/validate_materials.hpp"

namespace boxwood {

namespace {

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

} // namespace

void validate_camera(const Camera& camera, const std::string& file, const std::string& where) {
    const std::string_view fault = transform_fault(camera.to_world);
    if (!fault.empty()) throw InputError(file, where + "to_world", std::string(fault));
    if (camera.perspective && !(camera.vertical_fov > 0.0f && camera.vertical_fov < std::numbers::pi_v<float>)) {
        throw InputError(file, where + "vertical_fov", "is not between 0 and pi");
    }
    if (!camera.perspective && !(camera.half_height > 0.0f && std::isfinite(camera.half_height))) {
        throw InputError(file, where + "half_height", "is not positive and finite");
    }
}

void validate(const Scene& scene, const std::string& file) {
    std::vector<MeshBounds> bounds;
    bounds.reserve(scene.meshes.size());
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        validate_mesh(scene.meshes[i], file, element("meshes", i));
        validate_materials(scene, scene.meshes[i], file, element("meshes", i));
        bounds.push_back(mesh_bounds(scene.meshes[i].positions));
    }
    for (std::size_t i = 0; i < scene.instances.size(); ++i) validate_instance(scene, i, bounds, file);
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        validate_camera(scene.cameras[i], file, element("cameras", i) + ".");
    }
    validate_materials(scene, file);
}

} // namespace boxwood
