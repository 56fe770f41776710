// SPDX-License-Identifier: MIT
// Triangles and rays at the ends of what floats hold, for trees and brute force to agree about.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "boxwood/scene.hpp"
#include "shared/ray.h"

namespace boxwood::test {

struct ExtremeRays {
    std::string name;
    Scene scene; ///< One mesh, placed once.
    std::vector<Ray> rays;
};

/// Triangles `aspect` times as long as wide around the origin, and rays that graze them at 1e-3 to 1e-6 from 1 to 1e6
/// away.
ExtremeRays sliver_rays(float aspect, std::uint32_t triangles, std::size_t rays, std::uint64_t seed);

/// Triangles whose coordinates have random bits, below 2^59, and rays between such points or at the triangles.
ExtremeRays random_bit_rays(std::uint32_t triangles, std::size_t rays, std::uint64_t seed);

} // namespace boxwood::test
