// SPDX-License-Identifier: MIT
#include "io/gltf_camera.hpp"

#include <cmath>
#include <numbers>

#include "scene/transform.hpp"

namespace boxwood {

namespace {

// A parent with unequal scale shears the frame below it, and a mirrored one turns it left-handed. Then the view keeps
// its direction and its up. A frame that is orthogonal but for rounding passes unchanged.
glm::dmat4 without_shear(const glm::dmat4& frame) {
    const glm::dvec3 x(frame[0]);
    const glm::dvec3 y(frame[1]);
    const glm::dvec3 z(frame[2]);
    const auto orthogonal = [](const glm::dvec3& a, const glm::dvec3& b) {
        constexpr double rounding = 0x1p-20; // a few units in the last place of float
        return std::abs(glm::dot(a, b)) <= rounding * glm::length(a) * glm::length(b);
    };
    if (orthogonal(x, y) && orthogonal(y, z) && orthogonal(z, x) && glm::dot(glm::cross(x, y), z) > 0.0) return frame;
    const glm::dvec3 back = glm::normalize(z);
    const glm::dvec3 up = glm::normalize(y - back * glm::dot(back, y));
    return {glm::dvec4(glm::cross(up, back), 0.0), glm::dvec4(up, 0.0), glm::dvec4(back, 0.0), frame[3]};
}

} // namespace

std::optional<Camera> load_camera(const GltfDocument& document, const PlacedNode& placed, Warnings& warnings) {
    const tinygltf::Node& node = document.model.nodes[placed.node];
    if (node.camera < 0) return std::nullopt;
    const std::string node_name = element("nodes", placed.node);
    if (!GltfDocument::has(node.camera, document.model.cameras.size())) {
        document.fail(node_name + ".camera", "names a camera that does not exist");
    }
    const tinygltf::Camera& source = document.model.cameras[static_cast<std::size_t>(node.camera)];
    const std::string where = element("cameras", static_cast<std::size_t>(node.camera));

    Camera camera;
    camera.name = node.name.empty() ? source.name : node.name;
    camera.to_world = glm::mat4(placed.to_world);
    if (!transform_fault(camera.to_world).empty()) {
        warnings.add(node_name, "the camera has no usable transform, left out");
        return std::nullopt;
    }
    camera.to_world = glm::mat4(without_shear(placed.to_world));
    camera.perspective = source.type == "perspective";
    if (camera.perspective) {
        camera.vertical_fov = static_cast<float>(source.perspective.yfov);
        if (camera.vertical_fov > 0.0f && camera.vertical_fov < std::numbers::pi_v<float>) return camera;
        warnings.add(where + ".perspective.yfov", "is not between 0 and pi, camera left out");
    } else {
        camera.half_height = static_cast<float>(source.orthographic.ymag);
        if (camera.half_height > 0.0f && std::isfinite(camera.half_height)) return camera;
        warnings.add(where + ".orthographic.ymag", "is not positive, camera left out");
    }
    return std::nullopt;
}

} // namespace boxwood
