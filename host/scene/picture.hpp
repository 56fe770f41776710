// SPDX-License-Identifier: MIT
// Pictures in PNG or JPEG files, read and written by stb.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "boxwood/material.hpp"

namespace boxwood {

enum class PictureFormat { png, jpeg };

/// By the first bytes of the file; none for any other format.
std::optional<PictureFormat> picture_format(std::span<const std::byte> file);

struct PictureSize {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
};

/// Of what the head of the file says, without decoding it. Throws InputError(image.name) when it is no PNG or JPEG.
PictureSize picture_size(const EncodedImage& image);

/// Whether a file has 16 bits per channel, by its head: PNG alone may. False for a file that is broken.
bool is_wide(const EncodedImage& image);

/// A decoded picture: 4 values per pixel, R first, rows from top to bottom; alpha is full where the file has none.
struct Picture {
    PictureSize size;
    std::vector<std::uint8_t> rgba;
    std::vector<std::uint16_t> rgba16{}; ///< In place of `rgba` where is_wide(): the same in 16 bits.
};

/// Throws InputError(image.name) when it cannot be decoded.
Picture decode_picture(const EncodedImage& image);

/// A PNG file of `channels` bytes per pixel, 1 to 4 (grey, grey and alpha, RGB, RGBA), rows from top to bottom. Throws
/// InputError(name) when the bytes are not of that size, and for pictures without pixels or with too many.
std::vector<std::byte> encode_png(const std::string& name, PictureSize size, std::uint32_t channels,
                                  std::span<const std::uint8_t> pixels);

} // namespace boxwood
