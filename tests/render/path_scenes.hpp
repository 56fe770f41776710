// SPDX-License-Identifier: MIT
// Scenes with known light.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "boxwood/procedural.hpp"
#include "boxwood/scene.hpp"
#include "scene/transform.hpp"

namespace boxwood::test {

inline Material matt(const glm::vec3& color) {
    Material material = plain_material();
    material.base_color = glm::vec4(color, 1.0f);
    return material;
}

inline Material metal(const glm::vec3& color, float roughness) {
    Material material;
    material.base_color = glm::vec4(color, 1.0f);
    material.roughness = roughness;
    return material;
}

inline Material lamp(const glm::vec3& radiance) {
    Material material = matt(glm::vec3(0.0f));
    material.emission = radiance;
    return material;
}

/// Adds a parallelogram that faces cross(u, v), of a material of its own.
inline void add_quad(Scene& scene, const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v,
                     const Material& material) {
    const auto index = static_cast<std::uint32_t>(scene.materials.size());
    Mesh mesh{"quad", {corner, corner + u, corner + u + v, corner + v}, {{0, 1, 2}, {0, 2, 3}}};
    mesh.materials = {index, index};
    scene.materials.push_back(material);
    scene.instances.push_back({"quad", static_cast<std::uint32_t>(scene.meshes.size()), glm::mat4(1.0f)});
    scene.meshes.push_back(mesh);
}

/// The plane y = 0 over [-4, 4]^2, facing up.
inline void add_floor(Scene& scene, const Material& material) {
    add_quad(scene, {-4, 0, 4}, {8, 0, 0}, {0, 0, -8}, material);
}

/// The scene, its lights and its camera times `scale`, a power of two.
inline Scene scaled(Scene scene, float scale) {
    for (Mesh& mesh : scene.meshes)
        for (glm::vec3& p : mesh.positions) p *= scale;
    for (Instance& instance : scene.instances) instance.transform[3] *= glm::vec4(scale, scale, scale, 1.0f);
    for (Light& light : scene.lights) {
        light.position *= scale;
        light.range *= scale;
        if (light.kind != LightKind::directional) light.intensity *= scale * scale;
    }
    for (Camera& camera : scene.cameras) {
        camera.to_world[3] *= glm::vec4(scale, scale, scale, 1.0f);
        camera.half_height *= scale;
    }
    return scene;
}

/// Looks along -y at [-half, half]^2 of the floor.
inline Camera camera_above(float half, float height = 2.0f) {
    return {"above", look_at({0, height, 0}, {0, 0, 0}, {0, 0, -1}), false, 0.8f, half};
}

/// Where the ray of pixel (x, y) of that camera meets the floor.
inline glm::dvec3 floor_point(float half, std::uint32_t across, std::uint32_t x, std::uint32_t y) {
    const double pixel = 2.0 * half / across;
    return {-half + (x + 0.5) * pixel, 0.0, -half + (y + 0.5) * pixel};
}

/// Irradiance at p with normal n from a polygon of unit radiance that p sees whole (Lambert 1760), radiance 1.
inline double polygon_irradiance(const glm::dvec3& p, const glm::dvec3& n, const std::vector<glm::dvec3>& corners) {
    double sum = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 a = glm::normalize(corners[i] - p);
        const glm::dvec3 b = glm::normalize(corners[(i + 1) % corners.size()] - p);
        const glm::dvec3 edge = glm::cross(a, b);
        sum += std::acos(glm::clamp(glm::dot(a, b), -1.0, 1.0)) * glm::dot(glm::normalize(edge), n);
    }
    return 0.5 * std::abs(sum);
}

/// glTF's metallic-roughness model in double precision: f cos, by the formulas of appendix B of its specification.
inline glm::dvec3 reference_bsdf(const Material& m, const glm::dvec3& n, const glm::dvec3& wo, const glm::dvec3& wi) {
    const double cos_o = glm::dot(n, wo), cos_i = glm::dot(n, wi);
    if (cos_o <= 0 || cos_i <= 0) return glm::dvec3(0.0);
    const glm::dvec3 h = glm::normalize(wo + wi), color(m.base_color);
    const double a2 = std::pow(double(m.roughness), 4.0), cos_h = glm::dot(n, h), facing = glm::dot(wo, h);
    const double d = a2 / (std::numbers::pi * std::pow(cos_h * cos_h * (a2 - 1) + 1, 2.0));
    const double visible =
        0.5 / (cos_i * std::sqrt(cos_o * cos_o * (1 - a2) + a2) + cos_o * std::sqrt(cos_i * cos_i * (1 - a2) + a2));
    const double schlick = std::pow(1 - facing, 5.0);
    const double dielectric = m.specular * (0.04 + 0.96 * schlick);
    const glm::dvec3 plastic = (1 - dielectric) * color / std::numbers::pi + dielectric * d * visible;
    const glm::dvec3 metallic = (color + (1.0 - color) * schlick) * d * visible;
    return cos_i * glm::mix(plastic, metallic, double(m.metallic));
}

/// Directional albedo of GGX with single scattering, height-correlated Smith shadowing (Heitz 2014) and Schlick's
/// reflectance from f0 to f90, by the midpoint rule over tan(h) = alpha sqrt(p / (1 - p)), by which the distribution is
/// uniform in p, and over p = 1 - q^2, which takes the integrand's pole at p = 1 away.
inline double ggx_albedo(double cosine, double alpha, int across, double f0 = 1.0, double f90 = 1.0) {
    const glm::dvec3 o(std::sqrt(1 - cosine * cosine), 0, cosine);
    const auto shadow = [&](const glm::dvec3& w) {
        return 0.5 * (std::sqrt(1 + alpha * alpha * (1 / (w.z * w.z) - 1)) - 1);
    };
    double sum = 0.0;
    for (int j = 0; j < across; ++j)
        for (int k = 0; k < across; ++k) {
            const double q = (j + 0.5) / across, phi = 2 * std::numbers::pi * (k + 0.5) / across;
            const double tangent = alpha * std::sqrt(1 - q * q) / q;
            const glm::dvec3 h = glm::normalize(glm::dvec3(tangent * std::cos(phi), tangent * std::sin(phi), 1.0));
            const double facing = glm::dot(o, h);
            const glm::dvec3 i = 2 * facing * h - o;
            if (facing <= 0 || i.z <= 0) continue;
            const double fresnel = f0 + (f90 - f0) * std::pow(1 - facing, 5.0);
            sum += 2 * q * fresnel * facing / (o.z * h.z) / (1 + shadow(o) + shadow(i));
        }
    return sum / (double(across) * across);
}

/// A sphere of latitudes and longitudes, with or without vertex normals.
inline Mesh sphere_mesh(std::uint32_t across, bool smooth) {
    Mesh mesh{"sphere", {}, {}};
    for (std::uint32_t j = 0; j <= across; ++j)
        for (std::uint32_t i = 0; i <= 2 * across; ++i) {
            const double theta = std::numbers::pi * j / across, phi = std::numbers::pi * i / across;
            const glm::vec3 p(std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi));
            mesh.positions.push_back(p);
            if (smooth) mesh.normals.push_back(p);
        }
    const std::uint32_t row = 2 * across + 1;
    for (std::uint32_t j = 0; j < across; ++j)
        for (std::uint32_t i = 0; i < 2 * across; ++i) {
            const std::uint32_t a = j * row + i, b = a + row;
            if (j > 0) mesh.triangles.push_back({a, b, a + 1});
            if (j + 1 < across) mesh.triangles.push_back({a + 1, b, b + 1});
        }
    return mesh;
}

/// The Cornell box: a red and a green wall, a block of rough metal, a lamp.
inline Scene cornell_scene() {
    Scene scene = make_procedural("cornell");
    scene.materials = {matt(glm::vec3(0.7f)), matt({0.6f, 0.06f, 0.05f}), matt({0.12f, 0.45f, 0.09f}),
                       metal({0.9f, 0.7f, 0.4f}, 0.4f), lamp({17, 12, 6})};
    const auto material_of_mesh = [](const std::string& name) {
        if (name == "left wall") return 1u;
        if (name == "right wall") return 2u;
        if (name == "tall block") return 3u;
        return name == "light" ? 4u : 0u;
    };
    for (Mesh& mesh : scene.meshes) mesh.materials.assign(mesh.triangles.size(), material_of_mesh(mesh.name));
    scene.lights.clear();
    return scene;
}

} // namespace boxwood::test
