// SPDX-License-Identifier: MIT
// A G-buffer's pixels in double precision, and how far roundings may take them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "boxwood/scene.hpp"
#include "scene/picture.hpp"
#include "shared/camera.h"
#include "shared/ray.h"

namespace boxwood::test {

/// Colours of the scene's textures: 4 x 4 texels, and one that bends normals.
inline constexpr std::uint32_t texture_size = 4;
inline constexpr std::uint8_t bump_texel[] = {200, 90, 220, 255};

inline double linear(double byte) {
    const double c = byte / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

inline glm::dvec3 dvec(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

/// A hit's triangle in double precision.
struct PixelOracle {
    const Mesh& mesh;
    const Material& material;
    glm::dmat4 to_world;
    glm::uvec3 corner;
    glm::dvec3 weight, world[3];
    glm::dvec3 normal; ///< Of the triangle, towards the ray's origin.

    PixelOracle(const Scene& scene, const Ray& ray, const Hit& hit)
        : mesh(scene.meshes[scene.instances[hit.instance].mesh]),
          material(scene.materials[mesh.materials[hit.primitive]]), to_world(scene.instances[hit.instance].transform),
          corner(mesh.triangles[hit.primitive]), weight(1.0 - hit.u - hit.v, hit.u, hit.v) {
        for (int i = 0; i < 3; ++i) world[i] = glm::dvec3(to_world * glm::dvec4(mesh.positions[corner[i]], 1.0));
        normal = glm::normalize(glm::cross(world[1] - world[0], world[2] - world[0]));
        if (glm::dot(normal, dvec(ray.direction)) > 0.0) normal = -normal;
    }
    template <class Vector>
    auto interpolate(const std::vector<Vector>& attribute, const glm::dvec3& w) const {
        using Double = glm::vec<Vector::length(), double>;
        return w.x * Double(attribute[corner.x]) + w.y * Double(attribute[corner.y]) +
               w.z * Double(attribute[corner.z]);
    }
    /// The largest magnitude that meets in a point of the triangle, in world space.
    double magnitude() const {
        double most = 0.0;
        for (int row = 0; row < 3; ++row)
            for (int i = 0; i < 3; ++i) {
                double sum = std::fabs(to_world[3][row]);
                for (int c = 0; c < 3; ++c) sum += std::fabs(to_world[c][row] * mesh.positions[corner[i]][c]);
                most = std::max(most, sum);
            }
        return most;
    }
    /// By how much a direction's relative error may grow on its way to world space.
    double stretch() const {
        const glm::dmat3 m(to_world), inverse = glm::inverse(m);
        const auto square = [](const glm::dmat3& each) {
            return glm::dot(each[0], each[0]) + glm::dot(each[1], each[1]) + glm::dot(each[2], each[2]);
        };
        return std::sqrt(square(m) * square(inverse));
    }
    /// The same for the triangle's normal, which is longer than its edges' product only by the sine between them.
    double slant() const {
        const glm::dvec3 a(mesh.positions[corner.y] - mesh.positions[corner.x]);
        const glm::dvec3 b(mesh.positions[corner.z] - mesh.positions[corner.x]);
        return glm::length(a) * glm::length(b) / glm::length(glm::cross(a, b)) * stretch();
    }
    glm::dvec3 position() const { return weight.x * world[0] + weight.y * world[1] + weight.z * world[2]; }
    /// Where the plane of the triangle is met, as weights.
    glm::dvec3 weights_at(const glm::dvec3& origin, const glm::dvec3& direction) const {
        const glm::dvec3 v =
            glm::inverse(glm::dmat3(world[1] - world[0], world[2] - world[0], -direction)) * (origin - world[0]);
        return {1.0 - v.x - v.y, v.x, v.y};
    }
    /// `growth`: that of roundings on the way.
    glm::dvec3 shading_normal(double& growth) const {
        const glm::dvec3 between = interpolate(mesh.normals, weight), n = glm::normalize(between);
        growth = stretch() / glm::length(between);
        const glm::dmat3 linear_part(to_world);
        const glm::dvec3 straight = glm::normalize(glm::transpose(glm::inverse(linear_part)) * n);
        glm::dvec3 bent = straight;
        if (material.normal_texture.used()) {
            const glm::dvec4 both = interpolate(mesh.tangents, weight);
            const glm::dvec3 t = glm::normalize(glm::dvec3(both));
            const glm::dvec3 b = double{mesh.tangents[corner.x].w} * glm::cross(n, t);
            const double scale = material.normal_scale;
            const glm::dvec3 sum = scale * (2.0 * bump_texel[0] / 255 - 1.0) * glm::normalize(linear_part * t) +
                                   scale * (2.0 * bump_texel[1] / 255 - 1.0) * glm::normalize(linear_part * b) +
                                   (2.0 * bump_texel[2] / 255 - 1.0) * straight;
            bent = glm::normalize(sum);
            growth = (growth + stretch() / glm::length(glm::dvec3(both))) / glm::length(b) / glm::length(sum);
        }
        return glm::dot(straight, normal) < 0.0 ? -bent : bent;
    }
    /// Texture coordinates of the colour, in texels; `magnitude`: the largest that meets in them.
    glm::dvec2 texel(double& magnitude) const {
        const TextureUse& use = material.base_color_texture;
        magnitude = 0.0;
        for (int i = 0; i < 3; ++i)
            for (int row = 0; row < 2; ++row) {
                const glm::vec3 uv(mesh.uvs[use.uv_set][corner[i]], 1.0f);
                double sum = 0.0;
                for (int c = 0; c < 3; ++c)
                    sum += texture_size * std::fabs(double{use.transform[c][row]} * double{uv[c]});
                magnitude = std::max(magnitude, sum);
            }
        const glm::dvec2 uv = interpolate(mesh.uvs[use.uv_set], weight);
        return double{texture_size} * glm::dvec2(glm::dmat3(use.transform) * glm::dvec3(uv, 1.0));
    }
    glm::dvec3 albedo(const Picture& picture, glm::dvec2 at) const {
        at = glm::floor(at);
        constexpr int n = texture_size;
        const int x = ((static_cast<int>(at.x) % n) + n) % n;
        int y = ((static_cast<int>(at.y) % (2 * n)) + 2 * n) % (2 * n);
        if (y >= n) y = 2 * n - 1 - y;
        glm::dvec3 color = glm::dvec3(material.base_color) * glm::dvec3(interpolate(mesh.colors, weight));
        for (int c = 0; c < 3; ++c) color[c] *= linear(picture.rgba[4 * (y * n + x) + c]);
        return color;
    }
};

/// The change of the first texture coordinates over a pixel, by the rays a thousandth of a pixel on. `magnitude`: the
/// largest number that meets in it.
inline glm::dvec4 derivatives(const PixelOracle& oracle, const CameraRecord& camera, const Ray& ray,
                              double& magnitude) {
    const glm::dvec3 origin = dvec(ray.origin), direction = dvec(ray.direction);
    const glm::dvec3 forward = camera.perspective ? direction / glm::dot(direction, dvec(camera.forward)) : direction;
    const auto weights_at = [&](const glm::dvec3& step) {
        return camera.perspective ? oracle.weights_at(origin, forward + step)
                                  : oracle.weights_at(origin + step, forward);
    };
    const glm::vec2* uv = oracle.mesh.uvs[0].data();
    const glm::dvec2 first(uv[oracle.corner.x]);
    const glm::dvec2 edges[2] = {glm::dvec2(uv[oracle.corner.y]) - first, glm::dvec2(uv[oracle.corner.z]) - first};
    magnitude = 0.0;
    constexpr double fraction = 1e-3;
    const auto change = [&](const glm::dvec3& half) {
        const glm::dvec3 w =
            (weights_at(2.0 * fraction * half) - weights_at(-2.0 * fraction * half)) / (2.0 * fraction);
        magnitude =
            std::max(magnitude, std::fabs(w.y) * glm::length(edges[0]) + std::fabs(w.z) * glm::length(edges[1]));
        return w.y * edges[0] + w.z * edges[1];
    };
    return {change(dvec(camera.right)), change(dvec(camera.up))};
}

} // namespace boxwood::test
