// SPDX-License-Identifier: MIT
// Light from infinitely far away.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace boxwood {

/// Radiance by direction, world space (largest_radiance: boxwood/material.hpp; what is out of range is an InputError in
/// rendering). Either the same everywhere, or a picture of the whole sphere: its rows go from +y (top) to -y, its
/// columns around y, the middle of the picture being +x and the right of that +z, as three.js, Blender and Khronos'
/// sample viewer place it: column 0.5 + atan2(z, x) / (2 pi) of the width.
struct Environment {
    glm::vec3 radiance{0.0f}; ///< Everywhere, when there is no picture; within [0, largest_radiance].
    std::uint32_t width = 0;  ///< 0: no picture.
    std::uint32_t height = 0;
    std::vector<glm::vec3> pixels; ///< width * height, rows top to bottom; within [0, largest_radiance].
    /// Angle in radians, finite, by which the picture is turned about +y, counter-clockwise as seen from above, as a
    /// node would be: by pi / 2 its middle comes to -z.
    float rotation = 0.0f;
};

/// A clear sky that is brightest at the sun, in front of scenes to their right, over a plain that fades into the
/// horizon, for scenes without light. The horizon's radiance is near 1.
Environment default_sky();

/// Reads R, G and B of an OpenEXR file as such a picture, of the first part that has them; where none has, Y as grey.
/// Infinity of 16 bits becomes 65504, their largest value; negative values and NaN become 0, larger ones and infinity
/// of 32 bits largest_radiance; either is counted in a line of `warnings`, which does not repeat the name. Throws
/// InputError when the file cannot be read, has more than 2^26 pixels, or has other channels, which it names.
Environment load_environment(const std::filesystem::path& file, std::vector<std::string>& warnings);

} // namespace boxwood
