// SPDX-License-Identifier: MIT
// Cameras as kernels see them.
#pragma once

#include "boxwood/buffer.hpp"
#include "boxwood/scene.hpp"
#include "shared/camera.h"
#include "shared/ray.h"

namespace boxwood {

/// The record of a camera for a picture of width x height pixels, each sampled at `jitter` (see CameraRecord). Throws InputError
/// for more than 2^23 pixels across or 2^32 - 1 in all.
Buffer<CameraRecord> upload_camera(Device& device, const Camera& camera, std::uint32_t width, std::uint32_t height,
                                   glm::vec2 jitter = glm::vec2(0.0f));

/// The rays of the pixels from number `first_pixel` on, row by row.
void primary_rays(Device& device, BufferView<const CameraRecord> camera, std::uint32_t first_pixel,
                  BufferView<Ray> rays);

} // namespace boxwood
