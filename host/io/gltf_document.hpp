// SPDX-License-Identifier: MIT
// A glTF file as far as its JSON and its buffers go: the container is open, every field that Boxwood reads has the
// right JSON type, and the buffers are in memory. Indices are checked where they are followed.
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
#include "io/gltf_warnings.hpp"

namespace boxwood {

/// "array[index]", the way elements are named in messages.
std::string element(std::string_view array, std::size_t index);

struct GltfDocument {
    /// As long as the file says it is; or empty, with what is wrong with it.
    struct Buffer {
        std::span<const std::byte> bytes;
        std::string fault_place; ///< The element of the file, for messages.
        std::string fault;       ///< Empty for none.
    };

    std::string file;      ///< For messages.
    tinygltf::Model model; ///< Scenes, nodes, meshes, cameras, accessors and buffer views; no buffers, no materials.
    nlohmann::json
        appearance; ///< "materials", "textures", "samplers", "images" and "lights" as the file has them, checked.
    std::filesystem::path folder; ///< Of files that it names; empty when there is none.
    std::vector<Buffer> buffers;
    std::vector<std::vector<std::byte>> owned; ///< What `buffers` outside the file's own bytes point into.

    /// Throws InputError(file, where, what).
    [[noreturn]] void fail(const std::string& where, const std::string& what) const;

    /// True for 0 <= index < size.
    static bool has(int index, std::size_t size) { return index >= 0 && static_cast<std::size_t>(index) < size; }
};

/// Opens glTF text or a GLB container held in `bytes`, which must outlive the document. External buffers are read from
/// `folder` and may not lie outside it; an empty folder means that there are none. Throws InputError.
GltfDocument open_gltf(std::span<const std::byte> bytes, std::string file, const std::filesystem::path& folder,
                       Warnings& warnings);

/// load_gltf for a file in memory; `file` names it in messages, `folder` as in open_gltf.
Scene load_gltf_memory(std::span<const std::byte> bytes, std::string file, const std::filesystem::path& folder);

/// Reads a regular file whole. Throws InputError(name, where, ...) when it cannot be read or is no regular file;
/// `shown` is what the message quotes after that, such as the path where `name` is another file's, or nothing.
std::vector<std::byte> read_regular_file(const std::filesystem::path& path, const std::string& name,
                                         const std::string& where, const std::string& shown = {});

/// Whether a uri holds its data itself.
bool is_data_uri(std::string_view uri);

/// The bytes that a data: URI holds (base64 of either alphabet with or without line breaks and padding, or text; with
/// or without percent escapes), or the file in the document's folder that a relative one names. A path is tried with
/// its escapes decoded, as it is written, and, with a warning, with slashes for backslashes. Throws
/// InputError(document.file, where) when there are none, and for a path out of the folder.
std::vector<std::byte> load_uri(const GltfDocument& document, const std::string& uri, const std::string& where,
                                Warnings& warnings);

/// Parses glTF JSON, without what Boxwood never reads (animations, extras, foreign extensions).
/// Throws InputError when it is no JSON object.
nlohmann::json parse_gltf_json(std::string_view text, const std::string& file);

/// Checks the JSON type and range of every field that Boxwood or tinygltf reads, and puts right, with a warning, what
/// is wrong without harm: null, empty arrays, references of -1. Comes after check_required_extensions, because a file
/// may lack what an extension replaces. Throws InputError naming the field.
void check_gltf_fields(nlohmann::json& root, const std::string& file, Warnings& warnings);

/// Puts the buffers that `root` describes into `document`. `binary_chunk` is the GLB's own, or empty. One that has no
/// data, or too little, fails when something is read from it; a uri that gives none is warned of at once.
void load_buffers(GltfDocument& document, const nlohmann::json& root, std::span<const std::byte> binary_chunk,
                  Warnings& warnings);

} // namespace boxwood
