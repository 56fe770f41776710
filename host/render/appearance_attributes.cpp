// SPDX-License-Identifier: MIT
#include "render/appearance_attributes.hpp"

#include <algorithm>
#include <cmath>

#include "scene/materials_in_use.hpp"

namespace boxwood {

namespace {

/// What the triangles around a vertex say, each weighted by its area.
struct Frame {
    glm::dvec3 normal{0.0}; ///< Of the triangles, for vertices without one.
    glm::dvec3 tangent{0.0};
    glm::dvec3 bitangent{0.0};
};

/// Normalised, for any magnitude; zero stays zero.
glm::dvec3 normalized(const glm::dvec3& v) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (!(largest > 0.0)) return glm::dvec3(0.0);
    return glm::normalize(v / largest);
}

const Material* normal_mapped(const Scene& scene, const Mesh& mesh, std::size_t triangle) {
    const std::uint32_t index = material_of(scene, mesh, triangle);
    if (index >= scene.materials.size()) return nullptr;
    const Material& material = scene.materials[index];
    return material.normal_texture.used() ? &material : nullptr;
}

/// Adds a triangle to the frames of its vertices; nothing where its texture coordinates span no area.
void add_triangle(const Mesh& mesh, const glm::uvec3& triangle, const TextureUse& use, std::vector<Frame>& frames) {
    const std::vector<glm::vec2>& uvs = mesh.uvs[use.uv_set];
    const glm::dvec3 origin(mesh.positions[triangle.x]);
    const glm::dvec3 edge1 = glm::dvec3(mesh.positions[triangle.y]) - origin;
    const glm::dvec3 edge2 = glm::dvec3(mesh.positions[triangle.z]) - origin;
    const glm::dvec3 normal = glm::cross(edge1, edge2);
    const auto uv = [&](std::uint32_t vertex) {
        return glm::dvec2(glm::dmat3(use.transform) * glm::dvec3(glm::dvec2(uvs[vertex]), 1.0));
    };
    const glm::dvec2 uv1 = uv(triangle.y) - uv(triangle.x), uv2 = uv(triangle.z) - uv(triangle.x);
    const double side = uv1.x * uv2.y - uv2.x * uv1.y;
    const double area = glm::length(normal);
    if (!(area > 0.0) || side == 0.0 || !std::isfinite(side)) return;
    const double sign = side > 0.0 ? 1.0 : -1.0;
    const glm::dvec3 tangent = area * sign * normalized(edge1 * uv2.y - edge2 * uv1.y);
    const glm::dvec3 bitangent = area * sign * normalized(edge2 * uv1.x - edge1 * uv2.x);
    for (int corner = 0; corner < 3; ++corner) {
        Frame& frame = frames[triangle[corner]];
        frame.normal += normal;
        frame.tangent += tangent;
        frame.bitangent += bitangent;
    }
}

glm::vec4 tangent_of(const Frame& frame, const glm::vec3& vertex_normal) {
    const glm::dvec3 given = normalized(glm::dvec3(vertex_normal));
    const glm::dvec3 normal = given == glm::dvec3(0.0) ? normalized(frame.normal) : given;
    const glm::dvec3 sum = normalized(frame.tangent);
    const glm::dvec3 tangent = sum - normal * glm::dot(normal, sum);
    // What is left of a tangent along the normal is rounding.
    if (!(glm::length(tangent) > 0x1p-40)) return glm::vec4(0.0f);
    const glm::dvec3 unit = normalized(tangent);
    const double side = glm::dot(glm::cross(normal, unit), frame.bitangent);
    // v grows downwards in a picture, the second axis of a normal texture upwards (glTF 2.0, 3.9.3).
    return {glm::vec3(unit), side > 0.0 ? -1.0f : 1.0f};
}

/// The mesh's own tangents, and made ones where those are zero.
std::vector<glm::vec4> completed_tangents(const Scene& scene, const Mesh& mesh) {
    constexpr glm::vec4 none(0.0f);
    if (!mesh.tangents.empty() && std::find(mesh.tangents.begin(), mesh.tangents.end(), none) == mesh.tangents.end())
        return mesh.tangents;
    std::vector<glm::vec4> tangents = make_tangents(scene, mesh);
    if (tangents.empty()) return mesh.tangents;
    for (std::size_t i = 0; i < mesh.tangents.size(); ++i)
        if (mesh.tangents[i] != none) tangents[i] = mesh.tangents[i];
    return tangents;
}

template <class Vector>
void put(const std::vector<Vector>& values, std::size_t vertex, const Vector& missing, std::vector<float>& target) {
    const Vector& value = values.empty() ? missing : values[vertex];
    for (int i = 0; i < Vector::length(); ++i) target.push_back(value[i]);
}

} // namespace

std::vector<glm::vec4> make_tangents(const Scene& scene, const Mesh& mesh) {
    std::vector<Frame> frames;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Material* material = normal_mapped(scene, mesh, i);
        if (material == nullptr || mesh.uvs[material->normal_texture.uv_set].empty()) continue;
        if (frames.empty()) frames.resize(mesh.positions.size());
        add_triangle(mesh, mesh.triangles[i], material->normal_texture, frames);
    }
    std::vector<glm::vec4> tangents;
    tangents.reserve(frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i)
        tangents.push_back(tangent_of(frames[i], mesh.normals.empty() ? glm::vec3(0.0f) : mesh.normals[i]));
    return tangents;
}

std::vector<float> vertex_attributes(const Scene& scene, const ShadingRequirements& needs) {
    std::vector<float> attributes;
    if (needs.attribute_floats() == 0) return attributes;
    attributes.reserve(scene.vertex_count() * needs.attribute_floats());
    const std::vector<bool> shown = meshes_in_use(scene);
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const Mesh& mesh = scene.meshes[m];
        std::vector<glm::vec4> tangents;
        if (needs.tangents) tangents = shown[m] ? completed_tangents(scene, mesh) : mesh.tangents;
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            if (needs.normals) put(mesh.normals, i, glm::vec3(0.0f), attributes);
            if (needs.tangents) put(tangents, i, glm::vec4(0.0f), attributes);
            for (std::uint32_t set = 0; set < needs.uv_sets; ++set) put(mesh.uvs[set], i, glm::vec2(0.0f), attributes);
            if (needs.colors) put(mesh.colors, i, glm::vec4(1.0f), attributes);
        }
    }
    return attributes;
}

} // namespace boxwood
