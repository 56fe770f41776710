// SPDX-License-Identifier: MIT
#include "io/gltf_document.hpp"

#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>

#include "boxwood/error.hpp"
#include "common/excerpt.hpp"
#include "io/gltf_extensions.hpp"

namespace boxwood {

namespace {

constexpr std::size_t glb_header_size = 12;
constexpr std::size_t chunk_header_size = 8;
constexpr std::uint32_t json_chunk = 0x4e4f534a;   // "JSON"
constexpr std::uint32_t binary_chunk = 0x004e4942; // "BIN\0"

struct Container {
    std::string_view json;
    std::span<const std::byte> binary;
};

struct Chunk {
    std::uint32_t type;
    std::span<const std::byte> data;
};

std::uint32_t read_u32(std::span<const std::byte> bytes, std::size_t offset) {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;) value = value << 8 | std::to_integer<std::uint32_t>(bytes[offset + i]);
    return value;
}

bool is_glb(std::span<const std::byte> bytes) { return bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0; }

// Takes the first chunk off `rest`.
Chunk take_chunk(std::span<const std::byte>& rest, const std::string& file, const char* where) {
    if (rest.size() < chunk_header_size) throw InputError(file, where, "is truncated");
    const std::size_t size = read_u32(rest, 0);
    if (size > rest.size() - chunk_header_size) throw InputError(file, where, "is truncated");
    const Chunk chunk{read_u32(rest, 4), rest.subspan(chunk_header_size, size)};
    rest = rest.subspan(chunk_header_size + size);
    return chunk;
}

Container open_glb(std::span<const std::byte> bytes, const std::string& file) {
    if (bytes.size() < glb_header_size) throw InputError(file, "GLB header", "is truncated");
    if (read_u32(bytes, 4) != 2) throw InputError(file, "GLB header", "is not of version 2");
    const std::size_t length = read_u32(bytes, 8);
    if (length > bytes.size()) throw InputError(file, "GLB header", "says the file is longer than it is (truncated?)");
    if (length < glb_header_size) throw InputError(file, "GLB header", "says the file is shorter than its header");

    std::span<const std::byte> rest = bytes.subspan(glb_header_size, length - glb_header_size);
    const Chunk first = take_chunk(rest, file, "GLB chunk 0");
    if (first.type != json_chunk) throw InputError(file, "GLB chunk 0", "is not JSON");
    Container container{{reinterpret_cast<const char*>(first.data.data()), first.data.size()}, {}};
    if (!rest.empty()) {
        const Chunk second = take_chunk(rest, file, "GLB chunk 1");
        if (second.type == binary_chunk) container.binary = second.data; // readers ignore chunks they do not know
    }
    return container;
}

// Moved out of `root`: tinygltf would open the images.
nlohmann::json take_appearance(nlohmann::json& root) {
    nlohmann::json appearance = nlohmann::json::object();
    for (const char* key : {"materials", "textures", "samplers", "images"}) {
        const auto found = root.find(key);
        appearance[key] = found == root.end() ? nlohmann::json::array() : std::move(*found);
        root.erase(key);
    }
    appearance["lights"] = nlohmann::json::array();
    if (root.contains("/extensions/KHR_lights_punctual/lights"_json_pointer))
        appearance["lights"] = std::move(root["extensions"]["KHR_lights_punctual"]["lights"]);
    root.erase("extensions");
    return appearance;
}

/// What tinygltf refuses or follows unchecked; it is put back into the model that tinygltf makes.
struct Withheld {
    std::vector<std::size_t> strides;      ///< By buffer view, 0 for none.
    std::vector<std::vector<int>> indices; ///< By mesh and primitive, -1 for none.
};

Withheld withhold(nlohmann::json& root) {
    Withheld taken;
    nlohmann::json none = nlohmann::json::array();
    const auto list = [&none](nlohmann::json& owner, const char* key) -> nlohmann::json& {
        return owner.contains(key) ? owner[key] : none;
    };
    for (nlohmann::json& view : list(root, "bufferViews")) {
        taken.strides.push_back(view.value("byteStride", std::size_t{0}));
        view.erase("byteStride");
    }
    for (nlohmann::json& mesh : list(root, "meshes")) {
        std::vector<int>& indices = taken.indices.emplace_back();
        for (nlohmann::json& primitive : list(mesh, "primitives")) {
            indices.push_back(primitive.value("indices", -1));
            primitive.erase("indices");
        }
    }
    return taken;
}

void put_back(const Withheld& taken, tinygltf::Model& model) {
    for (std::size_t i = 0; i < model.bufferViews.size(); ++i) model.bufferViews[i].byteStride = taken.strides[i];
    for (std::size_t i = 0; i < model.meshes.size(); ++i)
        for (std::size_t k = 0; k < model.meshes[i].primitives.size(); ++k)
            model.meshes[i].primitives[k].indices = taken.indices[i][k];
}

// tinygltf turns checked JSON into typed structures. It gets neither buffers nor images, so it opens no file.
tinygltf::Model make_model(nlohmann::json root, const std::string& file) {
    root.erase("buffers");
    const Withheld taken = withhold(root);
    const std::string text = root.dump();
    root.clear();
    if (text.size() > std::numeric_limits<unsigned>::max()) throw InputError(file, "JSON", "is longer than 4 GiB");
    tinygltf::Model model;
    std::string error;
    std::string warning;
    tinygltf::TinyGLTF loader;
    const auto length = static_cast<unsigned>(text.size());
    if (!loader.LoadASCIIFromString(&model, &error, &warning, text.data(), length, "", tinygltf::NO_REQUIRE)) {
        while (!error.empty() && error.back() == '\n') error.pop_back();
        throw InputError(file, "", error.empty() ? "is not readable as glTF" : excerpt(error));
    }
    put_back(taken, model);
    return model;
}

} // namespace

std::string element(std::string_view array, std::size_t index) {
    return std::string(array) + "[" + std::to_string(index) + "]";
}

void GltfDocument::fail(const std::string& where, const std::string& what) const {
    throw InputError(file, where, what);
}

std::vector<std::byte> read_regular_file(const std::filesystem::path& path, const std::string& name,
                                         const std::string& where, const std::string& shown) {
    const auto fail = [&](const std::string& what) {
        throw InputError(name, where, what + (shown.empty() ? "" : ": " + excerpt(shown)));
    };
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) fail("does not exist");
    if (!std::filesystem::is_regular_file(status)) fail("is not a regular file");
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    std::ifstream stream(path, std::ios::binary);
    if (error || !stream) fail("cannot be opened");
    std::vector<std::byte> bytes(size);
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
    if (stream.gcount() != static_cast<std::streamsize>(size)) fail("cannot be read to its end");
    return bytes;
}

GltfDocument open_gltf(std::span<const std::byte> bytes, std::string file, const std::filesystem::path& folder,
                       Warnings& warnings) {
    if (bytes.empty()) throw InputError(file, "", "is empty");
    Container container{{reinterpret_cast<const char*>(bytes.data()), bytes.size()}, {}};
    if (is_glb(bytes)) container = open_glb(bytes, file);

    GltfDocument document;
    document.file = std::move(file);
    nlohmann::json root = parse_gltf_json(container.json, document.file);
    check_required_extensions(root, document.file);
    warn_of_extensions(root, warnings);
    check_gltf_fields(root, document.file, warnings);
    document.folder = folder;
    load_buffers(document, root, container.binary, warnings);
    document.appearance = take_appearance(root);
    document.model = make_model(std::move(root), document.file);
    return document;
}

} // namespace boxwood
