// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace boxwood {

/// One named plane of an image, rows top to bottom.
struct Channel {
    std::string name; ///< For example "R", "depth.Z", "normal.X", "instance.id".
    std::variant<std::vector<float>, std::vector<std::uint32_t>> samples; ///< width * height
};

/// A multi-channel image.
struct Image {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<Channel> channels;
};

/// Writes a multi-channel OpenEXR file (float as FLOAT, uint32 as UINT, ZIP), atomically. Throws InputError when the
/// file cannot be written or a channel has the wrong size or a repeated name.
void save_exr(const std::filesystem::path& file, const Image& image);

/// Writes an 8-bit RGB preview, atomically. `rgb` has 3 * width * height bytes. Throws InputError like save_exr.
void save_png(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height,
              std::span<const std::uint8_t> rgb);

} // namespace boxwood
