// SPDX-License-Identifier: MIT
#include "render/appearance_lights.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "render/light_tree.hpp"
#include "scene/materials_in_use.hpp"
#include "scene/transform.hpp"

namespace boxwood {

namespace {

void store(const glm::dvec3& v, float (&target)[3]) {
    for (int axis = 0; axis < 3; ++axis) target[axis] = static_cast<float>(v[axis]);
}

glm::dmat3 absolute(const glm::dmat3& m) { return {glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2])}; }

/// surface_clearance of cl/render/surface.h. `largest`: magnitudes of a triangle's vertices in object space; `normal`:
/// its unit normal in world space.
double clearance(const glm::dmat4& to_world, const glm::dvec3& largest, const glm::dvec3& normal) {
    const glm::dmat4 to_object = glm::inverse(to_world);
    const glm::dmat3 there = absolute(glm::dmat3(to_world)), back = absolute(glm::dmat3(to_object));
    const glm::dvec3 world = there * largest + glm::abs(glm::dvec3(to_world[3]));
    const glm::dvec3 returned = there * (back * world + glm::abs(glm::dvec3(to_object[3])));
    return 0x1p-24 * glm::dot(glm::abs(normal), 32.0 * world + 5.0 * returned);
}

double mean(const glm::dvec3& color) { return (color.x + color.y + color.z) / 3.0; }

/// The bounds of each light beside its record.
class Lights {
public:
    Lights(const Scene& scene, const std::vector<glm::dvec3>& emission) : scene_(scene), emission_(emission) {}

    void add_punctual() {
        for (const Light& light : scene_.lights) add(light);
    }

    void add_triangles() {
        const std::vector<std::vector<std::uint32_t>> emitting = emitting_triangles();
        for (std::size_t i = 0; i < scene_.instances.size(); ++i) {
            const std::uint32_t mesh = scene_.instances[i].mesh;
            if (emitting[mesh].empty()) continue;
            const glm::dmat4 to_world(scene_.instances[i].transform);
            const glm::dmat3 normal_to_world = glm::transpose(glm::inverse(glm::dmat3(to_world)));
            for (const std::uint32_t t : emitting[mesh])
                add(scene_.meshes[mesh], to_world, normal_to_world, static_cast<std::uint32_t>(i), t);
        }
    }

    LightList take() {
        if (records_.empty()) return {};
        std::vector<LightNode> nodes = light_tree(bounds_);
        return {std::move(records_), std::move(nodes)};
    }

private:
    /// By mesh, so that instances do not look for them again.
    std::vector<std::vector<std::uint32_t>> emitting_triangles() const {
        std::vector<std::vector<std::uint32_t>> emitting(scene_.meshes.size());
        for (std::size_t m = 0; m < scene_.meshes.size(); ++m)
            for (std::size_t t = 0; t < scene_.meshes[m].materials.size(); ++t)
                if (mean(emission_[material_of(scene_, scene_.meshes[m], t)]) > 0.0)
                    emitting[m].push_back(static_cast<std::uint32_t>(t));
        return emitting;
    }

    void add(const Light& light) {
        LightRecord record{};
        store(light.position, record.position);
        store(light.direction, record.direction);
        store(light.intensity, record.intensity);
        record.range = light.range;
        record.instance = record.primitive = BOXWOOD_NONE;
        if (light.kind == LightKind::point) {
            record.kind = BOXWOOD_POINT_LIGHT;
        } else if (light.kind == LightKind::directional) {
            record.kind = BOXWOOD_DIRECTIONAL_LIGHT;
        } else {
            record.kind = BOXWOOD_SPOT_LIGHT;
            const double inner = light.inner_cone, outer = light.outer_cone;
            // 1 - cos and differences of cosines, without cancellation.
            const double within = 2.0 * std::pow(std::sin(0.5 * outer), 2.0);
            const double fading = 2.0 * std::sin(0.5 * (outer + inner)) * std::sin(0.5 * (outer - inner));
            record.cone_scale = static_cast<float>(1.0 / std::sqrt(within));
            record.cone_edge = static_cast<float>(within / fading);
        }
        records_.push_back(record);
        bounds_.push_back(punctual_bounds(record));
    }

    void add(const Mesh& mesh, const glm::dmat4& to_world, const glm::dmat3& normal_to_world, std::uint32_t instance,
             std::uint32_t triangle) {
        const glm::uvec3 corners = mesh.triangles[triangle];
        glm::dvec3 vertex[3];
        for (int i = 0; i < 3; ++i) vertex[i] = glm::dvec3(mesh.positions[corners[i]]);
        const glm::dvec3 edges[2] = {vertex[1] - vertex[0], vertex[2] - vertex[0]};
        const glm::dvec3 along[2] = {glm::dmat3(to_world) * edges[0], glm::dmat3(to_world) * edges[1]};
        const double area = 0.5 * glm::length(glm::cross(along[0], along[1]));
        const glm::dvec3 normal = normal_to_world * glm::cross(edges[0], edges[1]);
        const double length = glm::length(normal);
        if (!(area > 0.0) || !(length > 0.0)) return;

        const std::uint32_t index = material_of(scene_, mesh, triangle);
        const Material material = index < scene_.materials.size() ? scene_.materials[index] : plain_material();
        LightRecord record{};
        record.kind = BOXWOOD_TRIANGLE_LIGHT;
        store(glm::dvec3(to_world * glm::dvec4(vertex[0], 1.0)), record.position);
        store(normal / length, record.direction);
        store(material.emission, record.intensity);
        store(along[0], record.edges[0]);
        store(along[1], record.edges[1]);
        record.range = std::numeric_limits<float>::infinity();
        record.inverse_size = static_cast<float>(1.0 / std::sqrt(area));
        const glm::dvec3 largest = glm::max(glm::abs(vertex[0]), glm::max(glm::abs(vertex[1]), glm::abs(vertex[2])));
        record.clearance = static_cast<float>(clearance(to_world, largest, normal / length));
        record.instance = instance;
        record.primitive = triangle;
        record.two_sided = material.double_sided ? 1u : 0u;
        records_.push_back(record);
        LightBounds bounds;
        glm::dvec3 placed[3];
        for (int i = 0; i < 3; ++i) placed[i] = glm::dvec3(to_world * glm::dvec4(vertex[i], 1.0));
        bounds.low = glm::min(placed[0], glm::min(placed[1], placed[2]));
        bounds.high = glm::max(placed[0], glm::max(placed[1], placed[2]));
        bounds.axis = normal / length;
        bounds.spread = material.double_sided ? std::numbers::pi : 0.0;
        bounds.strength = mean(emission_[index]) * area;
        bounds_.push_back(bounds);
    }

    const Scene& scene_;
    const std::vector<glm::dvec3>& emission_;
    std::vector<LightRecord> records_;
    std::vector<LightBounds> bounds_;
};

} // namespace

std::uint64_t light_limit(const Scene& scene, const ShadingRequirements& needs) {
    std::uint64_t count = needs.punctual ? scene.lights.size() : 0;
    if (!needs.emission) return count;
    std::vector<std::uint64_t> emitting(scene.meshes.size(), 0);
    for (std::size_t m = 0; m < scene.meshes.size(); ++m)
        for (std::size_t t = 0; t < scene.meshes[m].materials.size(); ++t) {
            const std::uint32_t material = material_of(scene, scene.meshes[m], t);
            emitting[m] += material < scene.materials.size() && emits(scene.materials[material]) ? 1 : 0;
        }
    for (const Instance& instance : scene.instances) count += emitting[instance.mesh];
    return count;
}

LightList light_list(const Scene& scene, const ShadingRequirements& needs, const std::vector<glm::dvec3>& emission) {
    Lights lights(scene, emission);
    if (needs.punctual) lights.add_punctual();
    if (needs.emission) lights.add_triangles();
    return lights.take();
}

} // namespace boxwood
