// SPDX-License-Identifier: MIT
// Channels of what one ray through the centre of each pixel meets.
#pragma once

#include <cstdint>
#include <vector>

#include "boxwood/render.hpp"
#include "render/path.hpp"

namespace boxwood {

/// Whether an AOV is of the light of the samples, not of the pixel's centre.
bool is_light(Aov aov);

/// How many channels it adds to a picture.
std::uint32_t channel_count(Aov aov);

/// Traces the pixels' centres, `options.batch` at a time, and adds the channels of those of `aovs` that are not of the
/// light.
void add_centre_channels(Device& device, const Scene& scene, const World& world, const Camera& camera,
                         const RenderOptions& options, const std::vector<Aov>& aovs, Image& image);

} // namespace boxwood
