// SPDX-License-Identifier: MIT
// Influence areas of the rays between surfaces and lights.
#include <algorithm>
#include <cmath>

#include "boxwood/influence.hpp"
#include "boxwood/scene.hpp"
#include "influence/area_fault.hpp"
#include "scene/world_box.hpp"

namespace boxwood {

namespace {

/// Of extents: what regions are larger, so that rays along their sides from surfaces there are inside.
constexpr double border = 0x1p-10;

double largest_component(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// Rows right, up, forward of areas along a direction.
glm::dmat3 frame_along(const glm::dvec3& direction) {
    InfluenceArea area;
    area.direction = direction;
    const InfluenceRecord record = influence_records({&area, 1}).front();
    glm::dmat3 columns;
    for (int k = 0; k < 3; ++k) {
        columns[0][k] = record.right[k];
        columns[1][k] = record.up[k];
        columns[2][k] = record.forward[k];
    }
    return glm::transpose(columns);
}

class LightAreas {
public:
    explicit LightAreas(const Scene& scene) : scene_(scene), corners_(instance_corners(scene)) {
        DoubleBox world;
        for (const glm::dvec3& corner : corners_) world.add(corner);
        for (int k = 0; k < 3; ++k) {
            box_.min[k] = static_cast<float>(world.lower[k]);
            box_.max[k] = static_cast<float>(world.upper[k]);
        }
        rounding_ = 0x1p-20 * std::max(largest_component(world.lower), largest_component(world.upper));
    }

    void add(const Light& light) {
        if (light.kind == LightKind::directional) return add_directional(light.direction);
        const double degrees = glm::degrees(double(light.outer_cone));
        if (light.kind == LightKind::spot && degrees <= widest_cone)
            return add_cone(light, light.direction, light.outer_cone);
        for (int face = 0; face < 6; ++face) {
            glm::dvec3 axis(0);
            axis[face / 2] = face % 2 == 0 ? 1 : -1;
            // The corners of a face are 54.7 degrees from its middle.
            const double angle =
                glm::degrees(std::acos(std::clamp(glm::dot(axis, glm::dvec3(light.direction)), -1.0, 1.0)));
            if (light.kind == LightKind::spot && angle > degrees + 55) continue;
            add_cone(light, axis, quarter_turn / 2);
        }
    }

    /// The emitting triangles of an instance, where they are flat.
    void add_lamp(const Instance& instance) {
        const Mesh& mesh = scene_.meshes[instance.mesh];
        std::vector<glm::dvec3> points; // three of each triangle
        glm::dvec3 normal(0);
        bool double_sided = false;
        for (std::size_t t = 0; t < mesh.materials.size(); ++t) {
            if (mesh.materials[t] == BOXWOOD_NONE) continue;
            const Material& material = scene_.materials[mesh.materials[t]];
            if (material.emission == glm::vec3(0.0f)) continue;
            for (int k = 0; k < 3; ++k)
                points.emplace_back(glm::dmat4(instance.transform) *
                                    glm::dvec4(mesh.positions[mesh.triangles[t][k]], 1.0));
            const glm::dvec3* corner = &points[points.size() - 3];
            const glm::dvec3 across = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
            if (glm::length(across) > glm::length(normal)) normal = across; // of the largest
            double_sided = double_sided || material.double_sided;
        }
        if (!(glm::length(normal) > 0)) return;
        // A mirror turns a triangle's corners about, and not its front.
        if (glm::determinant(glm::dmat3(instance.transform)) < 0) normal = -normal;
        add_rectangle(points, glm::normalize(normal));
        if (double_sided) add_rectangle(points, -glm::normalize(normal));
    }

    std::vector<InfluenceArea> take() { return std::move(areas_); }

private:
    static constexpr double widest_cone = 60, quarter_turn = 1.5707963267948966;

    void keep(const InfluenceArea& area) {
        if (areas_.size() < most_light_areas && area_fault(area).empty()) areas_.push_back(area);
    }

    void add_directional(const glm::dvec3& direction) {
        const glm::dmat3 frame = frame_along(direction);
        DoubleBox span;
        for (const glm::dvec3& corner : corners_) span.add(frame * corner);
        const double rim = border * largest_component(span.extents()) + rounding_;
        const glm::dvec3 middle = span.middle(), half = 0.5 * span.extents() + rim;
        InfluenceArea area;
        area.origin = glm::transpose(frame) * glm::dvec3(middle.x, middle.y, middle.z - half.z);
        area.direction = direction;
        area.half_width = half.x;
        area.half_height = half.y;
        area.far = 2 * half.z;
        keep(area);
    }

    /// From a light, to `angle` on each side of a direction.
    void add_cone(const Light& light, const glm::dvec3& direction, double angle) {
        InfluenceArea area;
        area.kind = AreaKind::point;
        area.origin = light.position;
        area.direction = direction;
        area.half_width = area.half_height = std::tan(angle) * (1 + border);
        const glm::dmat3 frame = frame_along(direction);
        area.far = 0;
        for (const glm::dvec3& corner : corners_)
            area.far = std::max(area.far, (frame * (corner - area.origin)).z * (1 + border));
        if (area.far > 0) area.far = std::min(area.far + rounding_, double(light.range));
        area.near = std::max(area.far * 0x1p-16, 1 / double(largest_coordinate));
        if (area_fault(area).empty() && intersects(influence_records({&area, 1}).front(), box_)) keep(area);
    }

    void add_rectangle(const std::vector<glm::dvec3>& points, const glm::dvec3& normal) {
        const glm::dmat3 frame = frame_along(normal);
        DoubleBox span;
        for (const glm::dvec3& p : points) span.add(frame * p);
        const double size = largest_component(span.extents());
        if (span.extents().z > border * size) return;
        const glm::dvec3 middle = span.middle(), half = 0.5 * span.extents() + border * size + rounding_;
        double far = middle.z;
        for (const glm::dvec3& corner : corners_) far = std::max(far, (frame * corner).z);
        InfluenceArea area;
        area.origin = glm::transpose(frame) * middle;
        area.direction = normal;
        area.half_width = half.x;
        area.half_height = half.y;
        if (!(far - middle.z > border * size)) return; // it shines out of the scene
        area.far = (far - middle.z) * (1 + border) + rounding_;
        area.tolerance_degrees =
            std::clamp(glm::degrees(std::atan2(2 * std::hypot(half.x, half.y), area.far)), 0.5, 45.0);
        keep(area);
    }

    const Scene& scene_;
    std::vector<glm::dvec3> corners_;
    Aabb box_{};          ///< Of the scene.
    double rounding_ = 0; ///< More than what origins, axes and placed positions round as floats.
    std::vector<InfluenceArea> areas_;
};

} // namespace

std::vector<InfluenceArea> areas_from_lights(const Scene& scene) {
    if (scene.instances.empty()) return {};
    LightAreas areas(scene);
    for (const Light& light : scene.lights) areas.add(light);
    for (const Instance& instance : scene.instances) areas.add_lamp(instance);
    return areas.take();
}

} // namespace boxwood
