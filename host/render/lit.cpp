// SPDX-License-Identifier: MIT
// Whether a scene brings light of its own.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "boxwood/render.hpp"
#include "boxwood/trace.hpp"
#include "scene/materials_in_use.hpp"
#include "scene/world_box.hpp"

namespace boxwood {

namespace {

constexpr std::size_t lamp_rays = 1024;
constexpr double least_fraction = 0.5, least_radiance = 0x1p-10;

/// A triangle that emits, in world space.
struct Lamp {
    glm::dvec3 corner, edges[2], normal; ///< The normal on the side that emits, normalised.
    bool both_sides;
    double power; ///< Over pi.
};

std::vector<Lamp> lamps_of(const Scene& scene) {
    std::vector<Lamp> lamps;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        const glm::dmat4 to_world(instance.transform);
        for (std::size_t t = 0; t < mesh.materials.size(); ++t) {
            const std::uint32_t index = material_of(scene, mesh, t);
            if (index >= scene.materials.size() || !emits(scene.materials[index])) continue;
            const Material& material = scene.materials[index];
            glm::dvec3 vertex[3];
            for (int i = 0; i < 3; ++i)
                vertex[i] = glm::dvec3(to_world * glm::dvec4(mesh.positions[mesh.triangles[t][i]], 1.0));
            Lamp lamp{vertex[0], {vertex[1] - vertex[0], vertex[2] - vertex[0]}, {}, material.double_sided, 0.0};
            const glm::dvec3 normal = glm::cross(lamp.edges[0], lamp.edges[1]);
            const double length = glm::length(normal);
            if (!(length > 0.0)) continue;
            // Front is where the vertices go around counter-clockwise in object space.
            lamp.normal = (glm::determinant(glm::dmat3(to_world)) < 0.0 ? -1.0 : 1.0) / length * normal;
            const glm::dvec3 emission(material.emission);
            lamp.power = 0.5 * length * (lamp.both_sides ? 2.0 : 1.0) * (emission.x + emission.y + emission.z) / 3.0;
            lamps.push_back(lamp);
        }
    }
    return lamps;
}

/// A point in [0, 1)^4: a sequence of low discrepancy, by powers of the root of x^5 = x + 1.
glm::dvec4 sequence(std::size_t i) {
    const glm::dvec4 step(0.8566748838545029, 0.733891856627126, 0.6287067210378087, 0.5385972572236101);
    return glm::fract((static_cast<double>(i) + 0.5) * step);
}

/// Leaves a lamp by the cosine.
Ray lamp_ray(const Lamp& lamp, const glm::dvec4& point, bool back) {
    const double root = std::sqrt(point.x), turn = 2.0 * std::numbers::pi * point.z;
    const glm::dvec3 from = lamp.corner + (1.0 - root) * lamp.edges[0] + root * point.y * lamp.edges[1];
    const glm::dvec3 up = (lamp.both_sides && back ? -1.0 : 1.0) * lamp.normal;
    const glm::dvec3 along = glm::normalize(lamp.edges[0]), across = glm::cross(up, along);
    const glm::dvec3 direction =
        std::sqrt(point.w) * (std::cos(turn) * along + std::sin(turn) * across) + std::sqrt(1.0 - point.w) * up;
    // Off the lamp itself, by more than coordinates round.
    const glm::dvec3 reach = glm::abs(from) + glm::abs(lamp.edges[0]) + glm::abs(lamp.edges[1]);
    const glm::vec3 o(from + 0x1p-20 * std::max({reach.x, reach.y, reach.z}) * up), d(direction);
    return {{o.x, o.y, o.z}, 0.0f, {d.x, d.y, d.z}, std::numeric_limits<float>::infinity()};
}

double surface_area(const glm::dvec3& extents) {
    return 2.0 * (extents.x * extents.y + extents.y * extents.z + extents.z * extents.x);
}

/// The fraction of the lamps' light that meets a surface.
double received_fraction(Device& device, const Tree& tree, const std::vector<Lamp>& lamps, double power) {
    std::vector<Ray> rays;
    std::size_t lamp = 0;
    double before = 0.0;
    for (std::size_t i = 0; i < lamp_rays; ++i) {
        const double wanted = power * (static_cast<double>(i) + 0.5) / lamp_rays;
        while (lamp + 1 < lamps.size() && before + lamps[lamp].power <= wanted) before += lamps[lamp++].power;
        rays.push_back(lamp_ray(lamps[lamp], sequence(i), i % 2 == 1));
    }
    Buffer<Hit> hits = make_buffer<Hit>(device, rays.size(), "hits of lamps");
    closest_hit(device, tree, upload(device, rays, "rays of lamps"), hits);
    const std::vector<Hit> found = download(device, hits);
    const auto met =
        std::count_if(found.begin(), found.end(), [](const Hit& h) { return h.primitive != BOXWOOD_NONE; });
    return static_cast<double>(met) / lamp_rays;
}

} // namespace

bool has_light(Device& device, const Scene& scene, const Tree& tree) {
    if (!scene.lights.empty()) return true;
    const std::vector<Lamp> lamps = lamps_of(scene);
    double power = 0.0;
    for (const Lamp& lamp : lamps) power += lamp.power;
    const auto box = world_box(scene);
    if (!box || !(power > least_radiance * surface_area(box->extents()))) return false;
    return received_fraction(device, tree, lamps, power) > least_fraction;
}

} // namespace boxwood
