// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>

#include "boxwood/render_options.hpp"

namespace boxwood {

/// Where in their squares all pixels take sample number `sample` (see CameraRecord): points of Sobol's sequence with a
/// digital shift by the seed, independent points for SamplerKind::random, the centre when there is one sample.
glm::vec2 camera_jitter(const LightOptions& options, std::uint32_t sample);

} // namespace boxwood
