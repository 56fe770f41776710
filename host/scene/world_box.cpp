// SPDX-License-Identifier: MIT
#include "scene/world_box.hpp"

#include <algorithm>
#include <cmath>

namespace boxwood {

void DoubleBox::add(const glm::dvec3& point) {
    lower = glm::min(lower, point);
    upper = glm::max(upper, point);
}

std::array<glm::dvec3, 8> DoubleBox::corners() const {
    std::array<glm::dvec3, 8> result;
    for (int i = 0; i < 8; ++i)
        result[i] = {(i & 1) ? upper.x : lower.x, (i & 2) ? upper.y : lower.y, (i & 4) ? upper.z : lower.z};
    return result;
}

std::vector<DoubleBox> mesh_boxes(const Scene& scene) {
    std::vector<DoubleBox> boxes(scene.meshes.size());
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        // In float, which is exact and what compilers make vectors of.
        glm::vec3 lower(std::numeric_limits<float>::infinity()), upper = -lower;
        for (const glm::vec3& position : scene.meshes[i].positions) {
            lower = glm::min(lower, position);
            upper = glm::max(upper, position);
        }
        boxes[i].lower = lower;
        boxes[i].upper = upper;
    }
    return boxes;
}

std::vector<glm::dvec3> instance_corners(const Scene& scene) {
    const std::vector<DoubleBox> meshes = mesh_boxes(scene);
    std::vector<glm::dvec3> corners;
    for (const Instance& instance : scene.instances)
        for (const glm::dvec3& corner : meshes.at(instance.mesh).corners())
            corners.emplace_back(glm::dmat4(instance.transform) * glm::dvec4(corner, 1.0));
    return corners;
}

std::optional<DoubleBox> world_box(const Scene& scene) {
    if (scene.instances.empty()) return std::nullopt;
    const std::vector<DoubleBox> meshes = mesh_boxes(scene);
    DoubleBox world;
    for (const Instance& instance : scene.instances) {
        const DoubleBox& box = meshes.at(instance.mesh);
        if (instance.transform == glm::mat4(1.0f)) {
            world.add(box.lower);
            world.add(box.upper);
            continue;
        }
        for (const glm::dvec3& corner : box.corners())
            world.add(glm::dmat4(instance.transform) * glm::dvec4(corner, 1.0));
    }
    return world;
}

SceneSphere scene_sphere(const Scene& scene) {
    SceneSphere sphere{};
    const std::optional<DoubleBox> box = world_box(scene);
    if (!box) return sphere;
    glm::dvec3 reach;
    for (int axis = 0; axis < 3; ++axis) {
        sphere.center[axis] = static_cast<float>(box->middle()[axis]);
        const double center = sphere.center[axis];
        reach[axis] = std::max(box->upper[axis] - center, center - box->lower[axis]);
    }
    // Rounded up, and never so small beside the coordinates that their roundings count.
    const double radius = std::max(
        glm::length(reach),
        0x1p-20 * std::max({std::fabs(box->middle().x), std::fabs(box->middle().y), std::fabs(box->middle().z)}));
    sphere.radius = std::nextafter(static_cast<float>(radius), std::numeric_limits<float>::infinity());
    return sphere;
}

} // namespace boxwood
