// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "boxwood/scene.hpp"

namespace boxwood {

/// What one level loses of an instance, as flatten() rounds its vertices to float in world space, where two levels keep
/// them as they are.
struct Rounding {
    std::uint32_t instance = 0; ///< Index into Scene::instances.
    double distance = 0.0;      ///< World units along an axis: the most that a vertex is moved by.
    double size = 0.0; ///< World units: the largest extent of the mesh's box where the instance has its corners.

    /// The distance as a part of the size; 0 for a mesh without extent, which no ray meets.
    double fraction() const { return size > 0.0 ? distance / size : 0.0; }
};

/// The largest Rounding::fraction() that Levels::automatic takes for nothing: half a pixel where the mesh fills a
/// picture of 8192, and about a degree by which facets of a hundredth of its size tilt. A mesh of size 1 passes it 2048
/// units from the origin; meshes that are modelled and placed around the origin are eight times below and more.
inline constexpr double rounding_limit = 0x1p-14;

/// Of one instance of a valid scene, exactly: 0 for the identity and wherever the transform needs no rounding.
/// O(vertices of its mesh).
Rounding rounding_of(const Scene& scene, std::uint32_t instance);

/// The instance of a valid scene with the largest fraction, the first of equals, where that is above rounding_limit;
/// none otherwise. O(vertices + instances), and as rounding_of for each instance that its mesh's box does not rule out.
std::optional<Rounding> worst_rounding(const Scene& scene);

/// True when every instance of a valid scene is no larger than the distance of neighbouring floats at its place, in
/// world space. Rays begin and end in such floats, so that hardly one meets anything, also with two levels. O(vertices
/// + instances).
bool collapses(const Scene& scene);

/// For reports, without an end: instances[0] of meshes[0] "ball" by up to 0.25 units, 2.5 % of its size
std::string words(const Rounding& rounding, const Scene& scene);

} // namespace boxwood
