// SPDX-License-Identifier: MIT
#include "render/camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "boxwood/error.hpp"
#include "scene/validate_camera.hpp"

namespace boxwood {

namespace {

void store(const glm::dvec3& v, float (&target)[3]) {
    for (int i = 0; i < 3; ++i) target[i] = static_cast<float>(v[i]);
}

/// A node's scale is not the camera's: the axes are normalised.
CameraRecord record_of(const Camera& camera, std::uint32_t width, std::uint32_t height, glm::vec2 jitter) {
    const glm::dmat4 to_world(camera.to_world);
    const double half_height =
        camera.perspective ? std::tan(0.5 * static_cast<double>(camera.vertical_fov)) : double{camera.half_height};
    // Pixels are square: half a pixel is as wide as high.
    const double half_pixel = half_height / std::max(height, 1u);
    CameraRecord record{};
    store(glm::dvec3(to_world[3]), record.origin);
    store(-glm::normalize(glm::dvec3(to_world[2])), record.forward);
    store(half_pixel * glm::normalize(glm::dvec3(to_world[0])), record.right);
    store(half_pixel * glm::normalize(glm::dvec3(to_world[1])), record.up);
    record.perspective = camera.perspective ? 1 : 0;
    record.width = width;
    record.height = height;
    record.jitter[0] = jitter.x;
    record.jitter[1] = jitter.y;
    return record;
}

} // namespace

Buffer<CameraRecord> upload_camera(Device& device, const Camera& camera, std::uint32_t width, std::uint32_t height,
                                   glm::vec2 jitter) {
    validate_camera(camera, "camera", "");
    constexpr std::uint32_t most_across = 1u << 23;
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    if (width > most_across || height > most_across || std::uint64_t{width} * height > most)
        throw InputError("camera", "resolution",
                         std::to_string(width) + " x " + std::to_string(height) +
                             " pixels; at most 2^23 across and 2^32 - 1 in all");
    for (int i = 0; i < 2; ++i)
        if (!(std::abs(jitter[i]) < 1.0f))
            throw InputError("camera", "jitter", std::to_string(jitter[i]) + " is not within (-1, 1)");
    return upload(device, std::vector<CameraRecord>{record_of(camera, width, height, jitter)}, "camera");
}

} // namespace boxwood
