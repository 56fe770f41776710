// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>

#include "boxwood/scene.hpp"
#include "boxwood/tree_image.hpp"

namespace boxwood {

/// Contents of a .bxw file.
struct BxwFile {
    Scene scene;
    TreeImage tree;
};

/// Version that save_bxw writes and the only one that load_bxw reads.
inline constexpr std::uint32_t bxw_version = 5;

/// Writes scene and tree as a little-endian container (magic, version, section table, checksum per section;
/// host/io/bxw_format.hpp has the layout), atomically: on failure nothing is left under `file`. Throws InputError when
/// scene or tree does not validate, so that no file is written that load_bxw refuses, and OutputError when the file
/// cannot be written. O(bytes); copies no big array.
void save_bxw(const std::filesystem::path& file, const Scene& scene, const TreeImage& tree);

/// Reads a .bxw file and validates its scene and tree. Throws InputError naming the file and the section or element for
/// a file that is missing, truncated, corrupt, newer, older or hostile, whatever its counts claim. Each section is read
/// into its final place: memory is about the file's size. O(bytes).
BxwFile load_bxw(const std::filesystem::path& file);

/// True when the file starts with the .bxw magic. False for anything else, also for a file that cannot be read.
bool is_bxw(const std::filesystem::path& file);

} // namespace boxwood
