// SPDX-License-Identifier: MIT
#include "scene/world_box.hpp"

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

std::vector<glm::dvec3> instance_corners(const Scene& scene) {
    std::vector<DoubleBox> meshes(scene.meshes.size());
    for (std::size_t i = 0; i < scene.meshes.size(); ++i)
        for (const glm::vec3& position : scene.meshes[i].positions) meshes[i].add(glm::dvec3(position));
    std::vector<glm::dvec3> corners;
    for (const Instance& instance : scene.instances)
        for (const glm::dvec3& corner : meshes.at(instance.mesh).corners())
            corners.emplace_back(glm::dmat4(instance.transform) * glm::dvec4(corner, 1.0));
    return corners;
}

std::optional<DoubleBox> world_box(const Scene& scene) {
    if (scene.instances.empty()) return std::nullopt;
    DoubleBox world;
    for (const glm::dvec3& corner : instance_corners(scene)) world.add(corner);
    return world;
}

} // namespace boxwood
