// SPDX-License-Identifier: MIT
#include "boxwood/rays.hpp"

#include <cmath>
#include <string>

#include "boxwood/error.hpp"
#include "runtime/launch.hpp"
#include "shared/camera.h"

namespace boxwood {

namespace {

constexpr std::uint32_t most_pixels_across = 1u << 23;

void store(const glm::dvec3& v, float (&target)[3]) {
    for (int i = 0; i < 3; ++i) target[i] = static_cast<float>(v[i]);
}

/// A node's scale is not the camera's: the axes are normalised.
CameraRecord record_of(const Camera& camera, std::uint32_t width, std::uint32_t height) {
    const glm::dmat4 to_world(camera.to_world);
    const double half_height =
        camera.perspective ? std::tan(0.5 * static_cast<double>(camera.vertical_fov)) : double{camera.half_height};
    // Pixels are square: half a pixel is as wide as high.
    const double half_pixel = half_height / height;
    CameraRecord record{};
    store(glm::dvec3(to_world[3]), record.origin);
    store(-glm::normalize(glm::dvec3(to_world[2])), record.forward);
    store(half_pixel * glm::normalize(glm::dvec3(to_world[0])), record.right);
    store(half_pixel * glm::normalize(glm::dvec3(to_world[1])), record.up);
    record.perspective = camera.perspective ? 1 : 0;
    record.width = width;
    record.height = height;
    return record;
}

void check_sizes(const char* function, std::size_t rays, std::size_t hits, std::size_t out) {
    if (rays != hits || rays != out)
        throw InputError(function, "arrays",
                         "rays, hits and result must have the same size, not " + std::to_string(rays) + ", " +
                             std::to_string(hits) + " and " + std::to_string(out));
}

} // namespace

void primary_rays(Device& device, const Camera& camera, std::uint32_t width, std::uint32_t height,
                  BufferView<Ray> rays) {
    if (width > most_pixels_across || height > most_pixels_across || std::size_t{width} * height != rays.size())
        throw InputError("primary_rays", "rays",
                         std::to_string(rays.size()) + " elements for " + std::to_string(width) + " x " +
                             std::to_string(height) + " pixels; at most 2^23 across");
    if (rays.size() == 0) return;
    const Buffer<CameraRecord> record =
        upload(device, std::vector<CameraRecord>{record_of(camera, width, height)}, "camera");
    const Slices slices = cut(device, rays.size());
    launch(device, {"render/camera.cl", "primary_rays"}, "primary rays", slices.slices, record,
           static_cast<std::uint32_t>(rays.size()), slices.length, rays);
}

void diffuse_rays(Device& device, const Geometry& geometry, BufferView<const Ray> rays, BufferView<const Hit> hits,
                  std::uint64_t seed, BufferView<Ray> out) {
    check_sizes("diffuse_rays", rays.size(), hits.size(), out.size());
    const Slices slices = cut(device, rays.size());
    launch(device, {"render/secondary.cl", "diffuse_rays"}, "diffuse rays", slices.slices, geometry.positions,
           geometry.triangles, geometry.meshes, geometry.instances, rays, hits, static_cast<std::uint32_t>(rays.size()),
           slices.length, seed, out);
}

void shadow_rays(Device& device, const Geometry& geometry, BufferView<const Ray> rays, BufferView<const Hit> hits,
                 const glm::vec3& light, BufferView<Ray> out) {
    check_sizes("shadow_rays", rays.size(), hits.size(), out.size());
    const Slices slices = cut(device, rays.size());
    launch(device, {"render/secondary.cl", "shadow_rays"}, "shadow rays", slices.slices, geometry.positions,
           geometry.triangles, geometry.meshes, geometry.instances, rays, hits, static_cast<std::uint32_t>(rays.size()),
           slices.length, light.x, light.y, light.z, out);
}

} // namespace boxwood
