// SPDX-License-Identifier: MIT
// Raster against rays, pixel by pixel.
#pragma once

#include <vector>

#include "boxwood/build.hpp"
#include "boxwood/raster.hpp"
#include "boxwood/rays.hpp"
#include "boxwood/scene.hpp"
#include "boxwood/trace.hpp"

namespace boxwood::test {

/// A picture's primary hits both ways.
struct BothHits {
    std::vector<Ray> rays;
    std::vector<Hit> traced, drawn;

    /// Pixels in which rays hit something.
    std::size_t hits() const;
    /// Pixels in which the two are not the same, bit for bit.
    std::size_t different() const;
};

/// One level and two, both layouts.
std::vector<BuildOptions> tree_options();

BothHits both_hits(Device& device, const Scene& scene, const BuildOptions& options, const Camera& camera,
                   std::uint32_t width, std::uint32_t height, glm::vec2 jitter = glm::vec2(0.0f));

} // namespace boxwood::test
