// SPDX-License-Identifier: MIT
// Levels of detail of a picture.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "scene/picture.hpp"

namespace boxwood {

/// Levels down to one texel: floor(log2(larger side)) + 1.
std::uint32_t level_count(PictureSize size);

/// Texels of all levels; each side is half of that before, rounded down, and at least 1.
std::uint64_t level_texels(PictureSize size);

/// The levels of a picture as TextureRecord has them, level 0 first, one word a texel, two of 16 bits: each texel is
/// the mean of what it covers of the level before, by area where a side is odd, in linear light when `srgb`, computed
/// in float and rounded to the picture's bits for the result only. Colour is not weighted by alpha, as sampling does
/// not either. O(texels).
std::vector<std::uint32_t> texture_levels(const Picture& picture, bool srgb);

/// Mean of R, G and B, linear. In double. O(texels).
glm::dvec3 mean_color(const Picture& picture, bool srgb);

} // namespace boxwood
