// SPDX-License-Identifier: MIT
// Where the bytes of buffers and images come from: the GLB's chunk, a data: URI, or a file in the scene's folder.
#include <algorithm>
#include <cstdint>
#include <system_error>

#include <nlohmann/json.hpp>

#include "boxwood/error.hpp"
#include "io/gltf_document.hpp"

namespace boxwood {

namespace {

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

// A percent sign that starts no escape stands for itself: file names from careless exporters contain them.
std::string percent_decode(std::string_view text) {
    std::string decoded;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool escape =
            text[i] == '%' && text.size() - i > 2 && hex_digit(text[i + 1]) >= 0 && hex_digit(text[i + 2]) >= 0;
        decoded += escape ? static_cast<char>(16 * hex_digit(text[i + 1]) + hex_digit(text[i + 2])) : text[i];
        if (escape) i += 2;
    }
    return decoded;
}

std::vector<std::byte> decode_data_uri(const std::string& uri, const std::string& file, const std::string& where) {
    static constexpr std::string_view marker = ";base64,";
    const std::size_t comma = uri.find(',');
    const std::size_t found = uri.find(marker);
    if (found == std::string::npos || found + marker.size() != comma + 1) {
        throw InputError(file, where, "is a data URI that is not base64");
    }
    // tinygltf knows a few media types only; the type means nothing for a buffer.
    std::vector<unsigned char> bytes;
    std::string media_type;
    const std::string plain = "data:application/octet-stream;base64," + uri.substr(comma + 1);
    if (!tinygltf::DecodeDataURI(&bytes, media_type, plain, 0, false)) {
        throw InputError(file, where, "is a data URI without data");
    }
    const auto first = reinterpret_cast<const std::byte*>(bytes.data());
    return {first, first + bytes.size()};
}

bool has_scheme(const std::string& uri) {
    const std::size_t colon = uri.find(':');
    return colon != std::string::npos && colon > 1 &&
           std::all_of(uri.begin(), uri.begin() + static_cast<std::ptrdiff_t>(colon), [](unsigned char c) {
               return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '+' ||
                      c == '-' || c == '.';
           });
}

// The file that a relative URI names. Symbolic links are followed before the check: the file itself must be inside.
std::filesystem::path resolve(const std::string& uri, const std::filesystem::path& folder, const std::string& file,
                              const std::string& where) {
    if (has_scheme(uri)) throw InputError(file, where, "is neither a data URI nor a relative path");
    const std::string decoded = percent_decode(uri);
    if (decoded.find('\0') != std::string::npos) throw InputError(file, where, "contains a zero byte");
    const std::filesystem::path relative(decoded);
    if (folder.empty()) throw InputError(file, where, "names a file, and this scene has no folder");
    std::error_code error;
    const std::filesystem::path inside = std::filesystem::weakly_canonical(folder, error);
    const std::filesystem::path target = std::filesystem::weakly_canonical(inside / relative, error);
    const auto split = std::mismatch(inside.begin(), inside.end(), target.begin(), target.end());
    const bool climbs = std::find(relative.begin(), relative.end(), "..") != relative.end();
    if (error || relative.is_absolute() || climbs || split.first != inside.end()) {
        throw InputError(file, where, "leaves the folder of the scene: " + decoded);
    }
    return target;
}

std::span<const std::byte> load_buffer(GltfDocument& document, const nlohmann::json& buffer, std::size_t index,
                                       std::span<const std::byte> binary_chunk) {
    const std::string where = element("buffers", index);
    const auto length = buffer.at("byteLength").get<std::uint64_t>();
    std::span<const std::byte> bytes;
    if (const auto uri = buffer.find("uri"); uri != buffer.end()) {
        document.owned.push_back(load_uri(document, uri->get_ref<const std::string&>(), where + ".uri"));
        bytes = document.owned.back();
    } else if (index == 0) {
        bytes = binary_chunk;
    }
    if (bytes.empty() && length > 0) document.fail(where, "has no data: no uri, and no binary chunk for it");
    if (length > bytes.size()) {
        document.fail(where,
                      "has " + std::to_string(bytes.size()) + " bytes where byteLength says " + std::to_string(length));
    }
    return bytes.first(length);
}

} // namespace

std::vector<std::byte> load_uri(const GltfDocument& document, const std::string& uri, const std::string& where) {
    if (uri.starts_with("data:")) return decode_data_uri(uri, document.file, where);
    return read_regular_file(resolve(uri, document.folder, document.file, where), document.file, where);
}

void load_buffers(GltfDocument& document, const nlohmann::json& root, std::span<const std::byte> binary_chunk) {
    const auto buffers = root.find("buffers");
    if (buffers == root.end()) return;
    for (std::size_t i = 0; i < buffers->size(); ++i) {
        document.buffers.push_back(load_buffer(document, (*buffers)[i], i, binary_chunk));
    }
}

} // namespace boxwood
