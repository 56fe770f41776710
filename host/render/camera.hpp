// SPDX-License-Identifier: MIT
// Primary rays of a part of a picture.
#pragma once

#include "boxwood/rays.hpp"

namespace boxwood {

/// The rays of the pixels from number `first_pixel` on, row by row.
void primary_rays(Device& device, BufferView<const CameraRecord> camera, std::uint32_t first_pixel,
                  BufferView<Ray> rays);

} // namespace boxwood
