// SPDX-License-Identifier: MIT
// Rays for rendering and measuring: from a camera, and from the hits of other rays.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "boxwood/geometry.hpp"
#include "shared/camera.h"
#include "shared/ray.h"

namespace boxwood {

/// The record of a camera for a picture of width x height pixels, each sampled at `jitter` (see CameraRecord). Throws
/// InputError for more than 2^23 pixels across or 2^32 - 1 in all, for a jitter not within (-1, 1), and for a camera
/// that does not keep the promises of Camera: a singular or non-finite transform, a field of view not in (0, pi), a
/// half height that is not positive and finite.
Buffer<CameraRecord> upload_camera(Device& device, const Camera& camera, std::uint32_t width, std::uint32_t height,
                                   glm::vec2 jitter = glm::vec2(0.0f));

/// One ray through the centre of each pixel, rows top to bottom; direction normalised, t in [0, inf). `rays` has width
/// * height elements, possibly none. Throws InputError when not, and as upload_camera does.
void primary_rays(Device& device, const Camera& camera, std::uint32_t width, std::uint32_t height,
                  BufferView<Ray> rays);

/// For every hit a ray from the hit point into a cosine-distributed direction on the side that `rays` came from; for
/// every miss a ray that hits nothing (zero direction). Depends on (seed, index) alone. The origin is moved off the
/// surface by a distance relative to the magnitudes that made it, so that it does not hit its own triangle.
void diffuse_rays(Device& device, const Geometry& geometry, BufferView<const Ray> rays, BufferView<const Hit> hits,
                  std::uint64_t seed, BufferView<Ray> out);

/// For every hit the segment from the hit point (moved off the surface as above) to `light`: unnormalised direction,
/// t in [0, 1); for every miss a ray that hits nothing.
void shadow_rays(Device& device, const Geometry& geometry, BufferView<const Ray> rays, BufferView<const Hit> hits,
                 const glm::vec3& light, BufferView<Ray> out);

/// A perspective camera that sees all of a valid scene (see validate) from outside, for scenes without one: from the
/// front, which in glTF is +z, and 15 degrees above, filling a picture of this ratio of width to height but for 5 % (of
/// meshes that are shown more than once, with their boxes). An empty scene gives the view of a cube of 2 at the origin.
/// O(vertices + instances). Throws InputError unless `aspect` is positive and finite.
Camera default_camera(const Scene& scene, float aspect = 1.0f);

/// A point for shadow rays: the middle of a valid scene's bounding box at 95 % of its height, which is under the
/// ceiling of a room and over most of an object. The origin for an empty scene. O(vertices + instances).
glm::vec3 default_light(const Scene& scene);

/// A distance for RenderOptions::ao_distance: a tenth of the diagonal of a valid scene's bounding box, so that corners
/// and what is near darken, but not the middle of a room. 1 for an empty scene or one that is a point. O(vertices +
/// instances).
float default_ao_distance(const Scene& scene);

} // namespace boxwood
