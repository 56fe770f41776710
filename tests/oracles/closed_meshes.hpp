// SPDX-License-Identifier: MIT
// Closed surfaces around a point, and rays from near that point which must all hit them.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "boxwood/scene.hpp"
#include "shared/ray.h"

namespace boxwood::test {

/// A sphere by stacks and slices, stretched and moved; with instances a turned, stretched and mirrored copy each, all
/// around the same point, so that every ray meets several surfaces.
struct ClosedKind {
    std::string name;
    std::uint32_t stacks = 16, slices = 32;
    glm::dvec3 radii{1.0};
    glm::dvec3 center{0.0};
    bool instances = false;
};

/// The meshes that the benchmark takes: 960 to 640,000 triangles, slender ones, and far from the origin.
std::vector<ClosedKind> closed_kinds();

struct ClosedScene {
    Scene scene;
    glm::dvec3 inside; ///< World space; everything within a tenth of the smallest radius is inside of all surfaces.
    double room;       ///< That tenth.
};

ClosedScene make_closed(const ClosedKind& kind);

/// What rays are aimed at.
enum class Aim {
    anywhere,
    edges,       ///< Points on edges of the first instance's triangles.
    vertices,    ///< Their vertices.
    along_edges, ///< Parallel to an edge.
    axes,        ///< One or two components are zero, of either sign.
    from_center, ///< As vertices and edges, from the center, to one coordinate of which the vertices are symmetric.
};
inline constexpr std::array all_aims = {Aim::anywhere,    Aim::edges, Aim::vertices,
                                        Aim::along_edges, Aim::axes,  Aim::from_center};

/// Rays of that kind, the same for the same seed.
std::vector<Ray> rays_from_inside(const ClosedScene& closed, Aim aim, std::size_t count, std::uint64_t seed);

} // namespace boxwood::test
