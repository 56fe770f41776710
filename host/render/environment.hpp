// SPDX-License-Identifier: MIT
// Environments on a device (cl/render/environment.h).
#pragma once

#include "boxwood/buffer.hpp"
#include "boxwood/environment.hpp"
#include "shared/environment.h"

namespace boxwood {

/// What programs are made for; the macro ENVIRONMENT.
enum class EnvironmentKind { none, constant, picture };

/// An environment on a device. Buffers that its kind does not read are empty.
struct EnvironmentMap {
    EnvironmentKind kind = EnvironmentKind::none;
    Buffer<EnvironmentRecord> record;
    Buffer<float> texels;  ///< 3 per texel.
    Buffer<float> rows;    ///< height + 2 values from 0 to 1: a row of patches is chosen with the difference.
    Buffer<float> columns; ///< The same within each row: (height + 1) * (width + 1).
    Buffer<float> rows_above_floor, columns_above_floor; ///< The same of what is brighter than the picture's mean.
};

/// Uploads an environment; one without light, or a picture that is black, is of kind none. Throws InputError for a
/// picture whose pixels are not width * height, or for the first that is not within [0, largest_radiance], or a
/// rotation that is not finite, and CapacityError when it does not fit. O(pixels).
EnvironmentMap upload_environment(Device& device, const Environment& environment);

} // namespace boxwood
