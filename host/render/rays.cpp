// SPDX-License-Identifier: MIT
#include "boxwood/rays.hpp"

#include <string>

#include "boxwood/error.hpp"
#include "render/camera.hpp"
#include "runtime/launch.hpp"

namespace boxwood {

namespace {

void check_sizes(const char* function, std::size_t rays, std::size_t hits, std::size_t out) {
    if (rays != hits || rays != out)
        throw InputError(function, "arrays",
                         "rays, hits and result must have the same size, not " + std::to_string(rays) + ", " +
                             std::to_string(hits) + " and " + std::to_string(out));
}

} // namespace

void primary_rays(Device& device, const Camera& camera, std::uint32_t width, std::uint32_t height,
                  BufferView<Ray> rays) {
    if (std::size_t{width} * height != rays.size())
        throw InputError("primary_rays", "rays",
                         std::to_string(rays.size()) + " elements for " + std::to_string(width) + " x " +
                             std::to_string(height) + " pixels");
    primary_rays(device, upload_camera(device, camera, width, height), 0, rays);
}

void primary_rays(Device& device, BufferView<const CameraRecord> camera, std::uint32_t first_pixel,
                  BufferView<Ray> rays) {
    if (rays.size() == 0) return;
    const Slices slices = cut(device, rays.size());
    launch(device, {"render/camera.cl", "primary_rays"}, "primary rays", slices.slices, camera, first_pixel,
           static_cast<std::uint32_t>(rays.size()), slices.length, rays);
}

void diffuse_rays(Device& device, const Geometry& geometry, BufferView<const Ray> rays, BufferView<const Hit> hits,
                  std::uint64_t seed, BufferView<Ray> out) {
    check_sizes("diffuse_rays", rays.size(), hits.size(), out.size());
    const Slices slices = cut(device, rays.size());
    launch(device, {"render/secondary.cl", "diffuse_rays", {{"LANES", "1"}, {"TRANSFORMS", "1"}}}, "diffuse rays",
           slices.slices, geometry.positions, geometry.triangles, geometry.meshes, geometry.instances, rays, hits,
           static_cast<std::uint32_t>(rays.size()), slices.length, seed, out);
}

void shadow_rays(Device& device, const Geometry& geometry, BufferView<const Ray> rays, BufferView<const Hit> hits,
                 const glm::vec3& light, BufferView<Ray> out) {
    check_sizes("shadow_rays", rays.size(), hits.size(), out.size());
    const Slices slices = cut(device, rays.size());
    launch(device, {"render/secondary.cl", "shadow_rays", {{"LANES", "1"}, {"TRANSFORMS", "1"}}}, "shadow rays",
           slices.slices, geometry.positions, geometry.triangles, geometry.meshes, geometry.instances, rays, hits,
           static_cast<std::uint32_t>(rays.size()), slices.length, light.x, light.y, light.z, out);
}

} // namespace boxwood
