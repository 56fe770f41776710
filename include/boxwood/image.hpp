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

/// Writes a multi-channel OpenEXR file (float as FLOAT, uint32 as UINT, ZIP), atomically. A name of "layer.part" makes
/// the channel a part of that layer. Throws InputError when the file cannot be written, when the image has no pixel or
/// no channel, or, naming the channel, when one has the wrong size or a name that is repeated, empty or longer than
/// 255 bytes.
void save_exr(const std::filesystem::path& file, const Image& image);

/// Writes an 8-bit RGB preview, atomically. `rgb` has 3 * width * height bytes, rows top to bottom. Throws
/// InputError when the file cannot be written, or when the size is 0, does not match or passes 1 GiB.
void save_png(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height,
              std::span<const std::uint8_t> rgb);

} // namespace boxwood
