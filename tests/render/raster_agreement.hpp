// SPDX-License-Identifier: MIT
// Raster against rays, pixel by pixel.
#pragma once

#include <string>
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
};

BothHits both_hits(Device& device, const Scene& scene, const BuildOptions& options, const Camera& camera,
                   std::uint32_t width, std::uint32_t height, glm::vec2 jitter = glm::vec2(0.0f));

struct Agreement {
    std::size_t pixels = 0;
    std::size_t hits = 0;      ///< Pixels that rays hit something in.
    std::size_t different = 0; ///< Pixels whose triangles differ.
    std::size_t off_edge = 0;  ///< Of those, the ones further from all edges of both triangles than roundings reach.
    std::size_t wrong = 0;     ///< Same triangle, but t, u or v differ by more than roundings.
    double farthest = 0.0;     ///< Of the different ones, from the nearest edge, in pixels.

    double share() const {
        return pixels == 0 ? 1.0 : 1.0 - static_cast<double>(different) / static_cast<double>(pixels);
    }
};

/// In double precision.
Agreement agreement(const Scene& scene, const Camera& camera, std::uint32_t height, const BothHits& both);

} // namespace boxwood::test
