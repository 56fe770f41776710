// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "boxwood/scene.hpp"
#include "boxwood/tree_image.hpp"

namespace boxwood {

/// Contents of a .bxw file.
struct BxwFile {
    Scene scene;
    TreeImage tree;
};

/// Version that save_bxw writes and the newest that load_bxw reads.
inline constexpr std::uint32_t bxw_version = 1;

/// Writes scene geometry and tree as a little-endian container (magic, version, section table, checksum per section),
/// atomically. Throws InputError when the file cannot be written.
void save_bxw(const std::filesystem::path& file, const Scene& scene, const TreeImage& tree);

/// Reads and validates a .bxw file. Throws InputError for a file that is truncated, corrupt, newer or hostile.
BxwFile load_bxw(const std::filesystem::path& file);

/// True when the file starts with the .bxw magic. False for anything else, also for a file that cannot be read.
bool is_bxw(const std::filesystem::path& file);

} // namespace boxwood
