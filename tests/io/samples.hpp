// SPDX-License-Identifier: MIT
// Small scenes and trees, made without any of the library's builders, for the tests of files and of TreeImage.
#pragma once

#include <filesystem>
#include <string>

#include "boxwood/bxw.hpp"

namespace boxwood::test {

/// Meshes of 1 and 37 triangles (37: the wide tree needs two levels, 32 fit in one), three instances (the first mesh
/// twice), one camera of each kind, a warning and counts; the second mesh has every attribute, and there are materials,
/// textures, pictures and lights of every kind.
Scene sample_scene();

/// The tree of a scene, halved by triangle order. Quality does not matter here; every promise of TreeImage does. With
/// oriented bounds every other volume stays aligned, and the others are the same boxes with their axes exchanged.
TreeImage sample_tree(const Scene& scene, Layout layout, Levels levels, Bounds bounds = Bounds::aabb);

/// Adds an influence area with a local tree over the first triangle to a sample tree of one level with axis-aligned
/// boxes, and an index of two cells.
void add_sample_area(TreeImage& tree);

/// Equality of everything, floats by their bits.
bool same(const Scene& a, const Scene& b);
bool same(const TreeImage& a, const TreeImage& b);

/// A new folder under the system's temporary folder, removed with its contents at the end of the scope.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::size_t entries() const;

private:
    std::filesystem::path path_;
};

std::string read_bytes(const std::filesystem::path& file);
void write_bytes(const std::filesystem::path& file, const std::string& bytes);

} // namespace boxwood::test
