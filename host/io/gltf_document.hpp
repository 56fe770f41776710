// SPDX-License-Identifier: MIT
// A glTF file as far as its JSON and its buffers go: the container is open, every field that Boxwood reads has the right
// JSON type, and the buffers are in memory. Indices are checked where they are followed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>
#include <tiny_gltf.h>

#include "boxwood/scene.hpp"

namespace boxwood {

/// "array[index]", the way elements are named in messages.
std::string element(std::string_view array, std::size_t index);

struct GltfDocument {
    std::string file;      ///< For messages.
    tinygltf::Model model; ///< Scenes, nodes, meshes, cameras, accessors and buffer views; no buffers, no materials.
    nlohmann::json looks; ///< "materials", "textures", "samplers", "images" and "lights" as the file has them, checked.
    std::filesystem::path folder;                    ///< Of files that it names; empty when there is none.
    std::vector<std::span<const std::byte>> buffers; ///< As long as the file says they are.
    std::vector<std::vector<std::byte>> owned;       ///< What `buffers` outside the file's own bytes point into.

    /// Throws InputError(file, where, what).
    [[noreturn]] void fail(const std::string& where, const std::string& what) const;

    /// True for 0 <= index < size.
    static bool has(int index, std::size_t size) { return index >= 0 && static_cast<std::size_t>(index) < size; }
};

/// Opens glTF text or a GLB container held in `bytes`, which must outlive the document. External buffers are read from
/// `folder` and may not lie outside it; an empty folder means that there are none. Throws InputError.
GltfDocument open_gltf(std::span<const std::byte> bytes, std::string file, const std::filesystem::path& folder);

/// load_gltf for a file in memory; `file` names it in messages, `folder` as in open_gltf.
Scene load_gltf_memory(std::span<const std::byte> bytes, std::string file, const std::filesystem::path& folder);

/// Reads a regular file whole. Throws InputError(name, where, ...) when it cannot be read or is no regular file.
std::vector<std::byte> read_regular_file(const std::filesystem::path& path, const std::string& name,
                                         const std::string& where);

/// The bytes that a data: URI holds, or the file in the document's folder that a relative one names. Throws InputError(document.file,
/// where) when there are none, and for a path out of the folder.
std::vector<std::byte> load_uri(const GltfDocument& document, const std::string& uri, const std::string& where);

/// Parses glTF JSON, without what Boxwood never reads (animations, skins, extras, foreign extensions).
/// Throws InputError when it is no JSON object.
nlohmann::json parse_gltf_json(std::string_view text, const std::string& file);

/// Throws InputError naming the first required extension that Boxwood does not support and that may change geometry.
void check_required_extensions(const nlohmann::json& root, const std::string& file);

/// Checks the JSON type and range of every field that Boxwood or tinygltf reads. Comes after check_required_extensions,
/// because a file may lack what an extension replaces. Throws InputError naming the field.
void check_gltf_fields(const nlohmann::json& root, const std::string& file);

/// The part of check_gltf_fields about materials, textures, images, samplers and lights.
void check_gltf_looks(const nlohmann::json& root, const std::string& file);

/// Puts the buffers that `root` describes into `document`. `binary_chunk` is the GLB's own, or empty. Throws InputError.
void load_buffers(GltfDocument& document, const nlohmann::json& root, std::span<const std::byte> binary_chunk);

} // namespace boxwood
