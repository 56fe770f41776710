// SPDX-License-Identifier: MIT
// Camera, light and distances for scenes that bring none.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <glm/gtc/constants.hpp>

#include "boxwood/error.hpp"
#include "boxwood/rays.hpp"
#include "scene/world_box.hpp"

namespace boxwood {

namespace {

/// Degrees above the horizon from which everything is seen, as by <model-viewer>, whose camera is 75 degrees from
/// straight above.
constexpr double elevation = 15.0;
constexpr double margin = 1.05;

/// Where a camera must be, in its own axes, for points to fill its picture: between two planes through it to the left
/// and right of them all, and between two above and below. Points are taken one by one.
class Frame {
public:
    /// Tangents of half the fields of view.
    Frame(double horizontal, double vertical) : tangents_{horizontal, vertical} {}

    void add(const glm::dvec3& point) {
        for (int axis = 0; axis < 2; ++axis) {
            upper_[axis] = std::max(upper_[axis], tangents_[axis] * point.z + point[axis]);
            lower_[axis] = std::max(lower_[axis], tangents_[axis] * point.z - point[axis]);
        }
        nearest_ = std::max(nearest_, point.z);
    }

    /// `back`: how far behind points that have no extent across.
    glm::dvec3 eye(double back) const {
        const glm::dvec2 distance = 0.5 * (upper_ + lower_) / tangents_, middle = 0.5 * (upper_ - lower_);
        const double z = std::max(distance.x, distance.y);
        return {middle, z > nearest_ ? z : nearest_ + back};
    }

private:
    glm::dvec2 tangents_;
    glm::dvec2 upper_{-std::numeric_limits<double>::infinity()}, lower_{upper_};
    double nearest_ = upper_.x;
};

/// Calls `take` with points of which all of a scene is the hull: vertices of meshes that are shown once, corners of the
/// boxes of the others' instances.
template <class Take>
void for_hull(const Scene& scene, const Take& take) {
    std::vector<std::uint32_t> shown(scene.meshes.size());
    for (const Instance& instance : scene.instances) ++shown[instance.mesh];
    const std::vector<DoubleBox> boxes = mesh_boxes(scene);
    for (const Instance& instance : scene.instances) {
        const glm::dmat4 to_world(instance.transform);
        const auto place = [&](const glm::dvec3& point) { take(glm::dvec3(to_world * glm::dvec4(point, 1.0))); };
        if (shown[instance.mesh] > 1)
            for (const glm::dvec3& corner : boxes[instance.mesh].corners()) place(corner);
        else
            for (const glm::vec3& position : scene.meshes[instance.mesh].positions) place(glm::dvec3(position));
    }
}

} // namespace

Camera default_camera(const Scene& scene, float aspect) {
    if (!(aspect > 0.0f && std::isfinite(aspect)))
        throw InputError("default_camera", "aspect", std::to_string(aspect) + " is not positive and finite");
    DoubleBox box{glm::dvec3(-1.0), glm::dvec3(1.0)};
    const auto world = world_box(scene);
    if (world) box = *world;
    const glm::dvec3 middle = box.middle();

    const double angle = glm::radians(elevation);
    const glm::dvec3 backward(0.0, std::sin(angle), std::cos(angle)), right(1.0, 0.0, 0.0);
    const glm::dmat3 axes(right, glm::cross(backward, right), backward);

    Camera camera;
    camera.name = "default";
    const double tangent = std::tan(0.5 * static_cast<double>(camera.vertical_fov)) / margin;
    Frame frame(tangent * aspect, tangent);
    const auto add = [&](const glm::dvec3& point) { frame.add(glm::transpose(axes) * (point - middle)); };
    if (world)
        for_hull(scene, add);
    else
        for (const glm::dvec3& corner : box.corners()) add(corner);
    camera.to_world = glm::mat4(glm::dmat4(axes));
    const glm::dvec3 eye = frame.eye(std::max(glm::length(middle), 1.0));
    camera.to_world[3] = glm::vec4(glm::dvec4(middle + axes * eye, 1.0));
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
