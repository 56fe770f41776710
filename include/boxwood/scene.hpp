// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "boxwood/material.hpp"
#include "shared/scene_sphere.h"

namespace boxwood {

/// Largest absolute coordinate that enters a scene: products of three differences stay inside float in traversal.
inline constexpr float largest_coordinate = 1152921504606846976.0f; // 2^60

/// An indexed triangle mesh in object space. Every position is finite and within largest_coordinate, every index is
/// below positions.size(), and there is at least one triangle. `materials` is empty (all plain) or has one element per
/// triangle. An attribute is empty or has one finite element per vertex, texture coordinates within largest_coordinate;
/// what is missing is made up where it is needed: the triangle's own normal, tangents from the texture coordinates,
/// white.
struct Mesh {
    std::string name;
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;
    std::vector<std::uint32_t> materials{}; ///< Per triangle, into Scene::materials; BOXWOOD_NONE: plain_material().
    std::vector<glm::vec3> normals{};       ///< Normalised, or zero for none.
    std::vector<glm::vec4> tangents{};      ///< Normalised or zero; w = 1 or -1: bitangent = w cross(normal, tangent).
    std::array<std::vector<glm::vec2>, 2> uvs{};
    std::vector<glm::vec4> colors{}; ///< Linear, alpha last; multiply the base colour.
};

/// One placement of a mesh. `transform` is affine (last row 0 0 0 1), finite and invertible in float; a mesh that is to
/// be flattened has to be flat itself (load_gltf makes such meshes).
struct Instance {
    std::string name;
    std::uint32_t mesh = 0;    ///< Index into Scene::meshes.
    glm::mat4 transform{1.0f}; ///< Object to world.
};

/// A pinhole or orthographic camera looking down its local -z, y up (the glTF convention).
struct Camera {
    std::string name;
    glm::mat4 to_world{1.0f}; ///< Rigid, or rigid with scale; never singular.
    bool perspective = true;
    float vertical_fov = 0.8f; ///< Radians; perspective only.
    float half_height = 1.0f;  ///< World units; orthographic only.
};

/// What the importer left out or changed, for the report.
struct ImportCounts {
    std::uint64_t dropped_triangles = 0; ///< With a vertex that is NaN, infinite or out of range.
    std::uint64_t dropped_instances = 0; ///< Whose transform is not finite or leaves no plane, or of a mesh left empty.
    std::uint64_t skipped_points_and_lines = 0; ///< Primitives of these modes.
};

/// A scene in plain host arrays; no OpenCL here. An empty scene (no instances) is valid.
struct Scene {
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;
    std::vector<Camera> cameras;
    std::vector<Material> materials;
    std::vector<Texture> textures;
    std::vector<EncodedImage> images;
    std::vector<Light> lights;
    ImportCounts counts;
    std::vector<std::string> warnings; ///< One line each, naming the element.

    /// Triangles stored, each mesh once. O(meshes).
    std::uint64_t triangle_count() const;
    /// Triangles as seen, each mesh once per instance. O(instances).
    std::uint64_t instanced_triangle_count() const;
    /// Vertices stored. O(meshes).
    std::uint64_t vertex_count() const;
};

/// Throws InputError(file, element, what) unless the scene keeps every promise made above. O(size).
void validate(const Scene& scene, const std::string& file);

/// The sphere around the box of all vertices where each instance has them. O(vertices + instances).
SceneSphere scene_sphere(const Scene& scene);

/// The scene as one mesh in world space with one identity instance, triangles in instance order; instance i's
/// triangles start at the sum of the triangle counts of the instances before it. Positions are transformed in double
/// and rounded once (boxwood/rounding.hpp tells what that loses). Of appearance nothing is kept: no attributes,
/// materials or lights. Cameras are kept. Throws CapacityError when the triangle count reaches 2^31.
Scene flatten(const Scene& scene);

} // namespace boxwood
