// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <glm/glm.hpp>

namespace boxwood {

/// One named plane of an image, rows top to bottom.
struct Channel {
    std::string name; ///< For example "R", "depth.Z", "normal.X", "instance.id".
    std::variant<std::vector<float>, std::vector<std::uint32_t>> samples; ///< width * height
};

/// What a file's header says about its image. Matrices act on columns, as everywhere in Boxwood.
using Attribute = std::variant<std::string, float, std::int32_t, glm::mat4>;

/// A multi-channel image.
struct Image {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<Channel> channels;
    std::map<std::string, Attribute> attributes{};
};

/// Writes a multi-channel OpenEXR file (float as FLOAT, uint32 as UINT, ZIP), atomically. A name of "layer.part" makes
/// the channel a part of that layer. Attributes become header attributes of the types string, float, int and m44f
/// (which acts on rows, as OpenEXR has it). The same image gives the same bytes. Throws OutputError when the file
/// cannot be written, InputError when the image has no pixel or no channel, or, naming it, when a channel has the wrong
/// size, or when the name of a channel or an attribute is repeated, empty or longer than 255 bytes, or that of an
/// attribute is one of OpenEXR's own ("channels", "compression", ...).
void save_exr(const std::filesystem::path& file, const Image& image);

/// Writes an 8-bit RGB preview, atomically. `rgb` has 3 * width * height bytes, rows top to bottom. Throws
/// OutputError when the file cannot be written, and InputError when the size is 0, does not match or passes 1 GiB.
void save_png(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height,
              std::span<const std::uint8_t> rgb);

} // namespace boxwood
