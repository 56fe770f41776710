// SPDX-License-Identifier: MIT
// Camera, light and distances for scenes that bring none.
#include <algorithm>
#include <cmath>

#include "boxwood/rays.hpp"
#include "scene/world_box.hpp"

namespace boxwood {

namespace {

/// How far back from the middle of `box` a camera with these axes must stand for all corners to be in front of it and
/// within a square field of view with this tangent of its half angle.
double fitting_distance(const DoubleBox& box, const glm::dvec3& middle, const glm::dmat3& axes, double tangent) {
    double distance = 0.0;
    for (const glm::dvec3& corner : box.corners()) {
        const glm::dvec3 local = glm::transpose(axes) * (corner - middle);
        distance = std::max(distance, local.z + std::max(std::abs(local.x), std::abs(local.y)) / tangent);
    }
    return distance;
}

} // namespace

Camera default_camera(const Scene& scene) {
    DoubleBox box{glm::dvec3(-1.0), glm::dvec3(1.0)};
    if (const auto world = world_box(scene)) box = *world;

    const glm::dvec3 backward = glm::normalize(glm::dvec3(1.0, 0.6, 1.2));
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), backward));
    const glm::dmat3 axes(right, glm::cross(backward, right), backward);

    Camera camera;
    camera.name = "default";
    const glm::dvec3 middle = box.middle();
    const double tangent = std::tan(0.5 * static_cast<double>(camera.vertical_fov));
    double distance = fitting_distance(box, middle, axes, tangent);
    if (distance == 0.0) distance = std::max(glm::length(middle), 1.0); // all of it one point: any view will do
    constexpr double margin = 1.05;
    camera.to_world = glm::mat4(glm::dmat4(axes));
    camera.to_world[3] = glm::vec4(glm::dvec4(middle + margin * distance * backward, 1.0));
    return camera;
}

glm::vec3 default_light(const Scene& scene) {
    const auto box = world_box(scene);
    if (!box) return glm::vec3(0.0f);
    glm::dvec3 light = box->middle();
    light.y = 0.05 * box->lower.y + 0.95 * box->upper.y;
    return glm::vec3(light);
}

float default_ao_distance(const Scene& scene) {
    const auto box = world_box(scene);
    const double distance = box ? glm::length(box->extents()) / 10.0 : 0.0;
    const auto rounded = static_cast<float>(distance);
    return rounded > 0.0f ? rounded : 1.0f;
}

} // namespace boxwood
