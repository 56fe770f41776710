// SPDX-License-Identifier: MIT
#include "cli/view.hpp"

#include <charconv>
#include <cmath>
#include <numbers>

#include <CLI/CLI.hpp>

#include "boxwood/rays.hpp"
#include "common/excerpt.hpp"
#include "scene/transform.hpp"

namespace boxwood::cli {

namespace {

/// "X,Y,Z".
glm::dvec3 to_point(const std::string& option, const std::string& text) {
    glm::dvec3 point;
    const char* next = text.data();
    const char* const end = next + text.size();
    for (int axis = 0; axis < 3; ++axis) {
        const auto [rest, status] = std::from_chars(next, end, point[axis]);
        const bool last = axis == 2;
        if (status != std::errc() || !(last ? rest == end : rest != end && *rest == ',') ||
            !(std::abs(point[axis]) <= double{largest_coordinate}))
            throw CLI::ValidationError(option, "\"" + text + "\" is not a point X,Y,Z, such as 0,1.5,-4");
        next = last ? rest : rest + 1;
    }
    return point;
}

std::string camera_list(const std::vector<Camera>& cameras) {
    if (cameras.empty()) return "the file has none; leave --camera out to see everything";
    std::string list = "the file has ";
    constexpr std::size_t most = 8;
    for (std::size_t i = 0; i < std::min(most, cameras.size()); ++i)
        list += (i ? ", " : "") + std::to_string(i) + " \"" + excerpt(cameras[i].name) + "\"";
    return cameras.size() > most ? list + " and " + std::to_string(cameras.size() - most) + " more" : list;
}

Camera stored_camera(const Input& input, const std::string& wanted, const Resolution& size) {
    const std::vector<Camera>& cameras = input.scene.cameras;
    const auto aspect = static_cast<float>(size.width) / static_cast<float>(size.height);
    if (wanted.empty()) return cameras.empty() ? default_camera(input.scene, aspect) : cameras.front();
    for (std::size_t i = 0; i < cameras.size(); ++i)
        if (cameras[i].name == wanted || std::to_string(i) == wanted) return cameras[i];
    throw InputError(input.file.string(), "cameras", "no camera \"" + wanted + "\"; " + camera_list(cameras));
}

/// Upright, but for views along y.
Camera placed_camera(const glm::dvec3& eye, const glm::dvec3& target) {
    const glm::dvec3 view = target - eye;
    if (glm::length(view) == 0.0) throw UsageError("--eye and --target are the same point");
    const glm::dvec3 along = glm::normalize(view);
    // What is too small beside y to turn the frame counts as nothing.
    const bool vertical = glm::length(glm::cross(glm::dvec3(0, 1, 0), along)) == 0.0;
    Camera camera;
    camera.name = "eye";
    // One unit ahead: the frame does not change with the distance, and far away does not cancel it.
    camera.to_world = look_at(glm::dvec3(0.0), along, vertical ? glm::dvec3(0, 0, -along.y) : glm::dvec3(0, 1, 0));
    camera.to_world[3] = glm::vec4(glm::vec3(eye), 1.0f);
    return camera;
}

} // namespace

void add_view(CLI::App& command, View& view) {
    CLI::Option* camera = command.add_option(
        "--camera", view.camera, "Name or index of the camera (default: the first, else a view of everything)");
    CLI::Option* eye = command.add_option_function<std::string>(
        "--eye", [&](const std::string& text) { view.eye = to_point("--eye", text); },
        "Look from this point instead, with --target");
    CLI::Option* target = command.add_option_function<std::string>(
        "--target", [&](const std::string& text) { view.target = to_point("--target", text); },
        "Point in the middle of the picture");
    eye->type_name("X,Y,Z")->needs(target)->excludes(camera);
    target->type_name("X,Y,Z")->needs(eye);
    command.add_option("--fov", view.field_of_view, "Vertical field of view in degrees, of perspective cameras")
        ->type_name("DEGREES");
}

Camera choose_camera(const Input& input, const View& view, const Resolution& resolution) {
    Camera camera = view.eye ? placed_camera(*view.eye, *view.target) : stored_camera(input, view.camera, resolution);
    if (!view.field_of_view) return camera;
    const auto angle = static_cast<float>(*view.field_of_view / 180.0 * std::numbers::pi);
    if (!(angle > 0.0f && angle < std::numbers::pi_v<float>)) // rounded, as the camera has it
        throw UsageError("--fov must lie between 0 and 180 degrees");
    if (!camera.perspective)
        throw UsageError("--fov: camera \"" + excerpt(camera.name) + "\" is orthographic and has none");
    camera.vertical_fov = angle;
    return camera;
}

} // namespace boxwood::cli
