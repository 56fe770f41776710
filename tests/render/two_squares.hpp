// SPDX-License-Identifier: MIT
// A small scene, its pictures, and their channels, for the tests of rendering.
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "boxwood/build.hpp"
#include "boxwood/render.hpp"
#include "support.hpp"

namespace boxwood::test {

// Odd, so that a pixel lies in the middle, and small.
inline constexpr std::uint32_t width = 33, height = 21;

/// Two squares before a camera at the origin: instance 0 faces it from the left half of z = -3; instance 1, mirrored
/// and stretched, is tilted and covers a part of the right half. Miss around them.
inline Scene two_squares(float scale) {
    Scene scene;
    scene.meshes.push_back({"square", {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}});
    const glm::mat4 world = glm::scale(glm::mat4(1.0f), glm::vec3(scale));
    const glm::mat4 left = glm::translate(glm::mat4(1.0f), glm::vec3(-1.25f, 0, -3));
    glm::mat4 right = glm::translate(glm::mat4(1.0f), glm::vec3(1.25f, 0, -4));
    right = glm::scale(right, glm::vec3(1, 1, 0.25f)); // after the turn: what tells the inverse transpose apart
    right = glm::rotate(right, 0.75f, glm::vec3(0, 1, 0));
    right = glm::scale(right, glm::vec3(-1, 1, 1));
    scene.meshes.push_back(scene.meshes[0]);
    scene.materials.resize(2); // the first is not used
    scene.materials[1].base_color = {0.25f, 0.5f, 0.75f, 1.0f};
    scene.meshes[1].materials = {1, BOXWOOD_NONE};
    scene.instances.push_back({"left", 0, world * left});
    scene.instances.push_back({"right", 1, world * right});
    return scene;
}

inline Camera wide_camera() {
    Camera camera;
    camera.vertical_fov = 1.2f;
    return camera;
}

/// AOVs of the pixels' centres, which every integrator has.
inline std::vector<Aov> centre_aovs() {
    return {Aov::depth,    Aov::normal,    Aov::position, Aov::albedo,
            Aov::instance, Aov::primitive, Aov::material, Aov::cost};
}

inline RenderOptions options_of(Integrator integrator, const std::vector<Aov>& aovs, std::uint32_t samples = 1) {
    RenderOptions options;
    options.light.integrator = integrator;
    options.light.samples = samples;
    options.width = width;
    options.height = height;
    options.aovs = aovs;
    return options;
}

inline Image picture(const Scene& scene, const std::vector<Aov>& aovs, const BuildOptions& options = {}) {
    Device& device = test_device();
    return render(device, scene, build(device, scene, options), {}, wide_camera(),
                  options_of(Integrator::normals, aovs));
}

template <class T>
const std::vector<T>& plane(const Image& image, const std::string& name) {
    for (const Channel& channel : image.channels)
        if (channel.name == name) return std::get<std::vector<T>>(channel.samples);
    throw std::runtime_error("no channel " + name);
}

inline bool contains(const Image& image, const std::string& name) {
    for (const Channel& channel : image.channels)
        if (channel.name == name) return true;
    return false;
}

inline glm::vec3 vector_at(const Image& image, const std::string& layer, std::string_view parts, std::size_t i) {
    glm::vec3 v;
    for (int c = 0; c < 3; ++c) v[c] = plane<float>(image, layer + parts[static_cast<std::size_t>(c)])[i];
    return v;
}

/// The same channels with the same bits.
inline bool same_channels(const Image& a, const Image& b) {
    if (a.channels.size() != b.channels.size()) return false;
    for (std::size_t c = 0; c < a.channels.size(); ++c) {
        if (a.channels[c].name != b.channels[c].name) return false;
        const bool same = std::visit(
            [&](const auto& samples) {
                using Samples = std::decay_t<decltype(samples)>;
                const auto* other = std::get_if<Samples>(&b.channels[c].samples);
                return other && same_bits(samples, *other);
            },
            a.channels[c].samples);
        if (!same) return false;
    }
    return true;
}

} // namespace boxwood::test
