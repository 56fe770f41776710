// SPDX-License-Identifier: MIT
// Where the bytes of buffers and images come from: the GLB's chunk, a data: URI, or a file in the scene's folder.
#include <algorithm>
#include <cstdint>
#include <optional>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>

#include "boxwood/error.hpp"
#include "common/excerpt.hpp"
#include "io/gltf_document.hpp"
#include "io/gltf_extensions.hpp"

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

bool equal_ignoring_case(std::string_view text, std::string_view lower) {
    return std::equal(text.begin(), text.end(), lower.begin(), lower.end(),
                      [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; });
}

/// The value of a digit of base64, plain or for uris; none for another character.
std::optional<std::uint32_t> base64_digit(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+' || c == '-') return 62;
    if (c == '/' || c == '_') return 63;
    return std::nullopt;
}

/// Throws InputError for a character that base64 has not; line breaks and padding are passed over.
std::vector<std::byte> decode_base64(std::string_view text, const std::string& file, const std::string& where) {
    std::vector<std::byte> bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    std::uint32_t bits = 0;
    int known = 0;
    for (const char c : text) {
        if (c == '=' || c == ' ' || c == '\t' || c == '\r' || c == '\n') continue;
        const std::optional<std::uint32_t> digit = base64_digit(c);
        if (!digit) throw InputError(file, where, "is a data URI with a character that is not base64");
        bits = bits << 6 | *digit;
        known += 6;
        if (known < 8) continue;
        known -= 8;
        bytes.push_back(static_cast<std::byte>(bits >> known));
    }
    return bytes;
}

/// As RFC 2397 has it, and more generous about base64.
std::vector<std::byte> decode_data_uri(const std::string& uri, const std::string& file, const std::string& where) {
    static constexpr std::string_view marker = ";base64";
    const std::size_t comma = uri.find(',');
    if (comma == std::string::npos) throw InputError(file, where, "is a data URI without data");
    const std::string_view head = std::string_view(uri).substr(0, comma);
    const bool encoded =
        head.size() >= marker.size() && equal_ignoring_case(head.substr(head.size() - marker.size()), marker);
    const std::string text = percent_decode(std::string_view(uri).substr(comma + 1));
    if (text.empty()) throw InputError(file, where, "is a data URI without data");
    if (encoded) return decode_base64(text, file, where);
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

bool has_scheme(const std::string& uri) {
    const std::size_t colon = uri.find(':');
    return colon != std::string::npos && colon > 1 &&
           std::all_of(uri.begin(), uri.begin() + static_cast<std::ptrdiff_t>(colon), [](unsigned char c) {
               return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '+' ||
                      c == '-' || c == '.';
           });
}

/// The file that a relative path names. Symbolic links are followed before the check: the file itself must be inside.
std::filesystem::path resolve(const std::string& path, const std::filesystem::path& folder, const std::string& file,
                              const std::string& where) {
    if (path.find('\0') != std::string::npos) throw InputError(file, where, "contains a zero byte");
    const std::filesystem::path relative(path);
    std::error_code error;
    const std::filesystem::path inside = std::filesystem::weakly_canonical(folder, error);
    const std::filesystem::path target = std::filesystem::weakly_canonical(inside / relative, error);
    const auto split = std::mismatch(inside.begin(), inside.end(), target.begin(), target.end());
    const std::filesystem::path straight = relative.lexically_normal();
    const bool climbs = !straight.empty() && *straight.begin() == "..";
    if (error || relative.is_absolute() || climbs || split.first != inside.end()) {
        throw InputError(file, where, "leaves the folder of the scene: " + excerpt(path));
    }
    return target;
}

std::vector<std::byte> load_file(const GltfDocument& document, const std::string& uri, const std::string& where,
                                 Warnings& warnings) {
    if (has_scheme(uri)) document.fail(where, "is neither a data URI nor a relative path: " + excerpt(uri));
    if (document.folder.empty()) document.fail(where, "names a file, and this scene has no folder: " + excerpt(uri));
    // What careless exporters write is tried last: names that are not escaped though they contain a percent sign,
    // backslashes.
    const std::string decoded = percent_decode(uri);
    std::vector<std::string> tries{decoded};
    if (decoded != uri) tries.push_back(uri);
    if (std::string slashes = decoded; slashes.find('\\') != std::string::npos) {
        std::replace(slashes.begin(), slashes.end(), '\\', '/');
        tries.push_back(std::move(slashes));
    }
    for (const std::string& path : tries) {
        const std::filesystem::path target = resolve(path, document.folder, document.file, where);
        std::error_code ignored;
        if (!std::filesystem::exists(target, ignored)) continue;
        if (path.find('\\') == std::string::npos && decoded.find('\\') != std::string::npos)
            warnings.add_repeated(where, "has backslashes, taken as slashes");
        return read_regular_file(target, document.file, where, path);
    }
    document.fail(where, "does not exist: " + excerpt(decoded));
}

/// Throws InputError when the data that the buffer should have is not there; `compression` is what may have taken its
/// place.
std::span<const std::byte> load_buffer(GltfDocument& document, const nlohmann::json& buffer, std::size_t index,
                                       std::span<const std::byte> binary_chunk, const std::string& compression,
                                       Warnings& warnings) {
    const std::string where = element("buffers", index);
    const auto length = buffer.at("byteLength").get<std::uint64_t>();
    std::span<const std::byte> bytes;
    if (const auto uri = buffer.find("uri"); uri != buffer.end()) {
        document.owned.push_back(load_uri(document, uri->get_ref<const std::string&>(), where + ".uri", warnings));
        bytes = document.owned.back();
    } else if (index == 0) {
        bytes = binary_chunk;
    }
    if (bytes.empty() && length > 0)
        document.fail(where, "has no data: no uri, and no binary chunk for it" + compression);
    if (length > bytes.size()) {
        document.fail(where,
                      "has " + std::to_string(bytes.size()) + " bytes where byteLength says " + std::to_string(length));
    }
    return bytes.first(length);
}

/// What the error says after the names of file and element.
std::string what_of(const InputError& error) {
    return std::string(error.what()).substr(error.file.size() + error.where.size() + 4); // ": " after each
}

} // namespace

bool is_data_uri(std::string_view uri) { return equal_ignoring_case(uri.substr(0, 5), "data:"); }

std::vector<std::byte> load_uri(const GltfDocument& document, const std::string& uri, const std::string& where,
                                Warnings& warnings) {
    if (is_data_uri(uri)) return decode_data_uri(uri, document.file, where);
    return load_file(document, uri, where, warnings);
}

void load_buffers(GltfDocument& document, const nlohmann::json& root, std::span<const std::byte> binary_chunk,
                  Warnings& warnings) {
    const auto buffers = root.find("buffers");
    if (buffers == root.end()) return;
    const std::string unread = unread_buffer_compression(root);
    const std::string compression = unread.empty() ? "" : " (" + unread + " is not read)";
    for (std::size_t i = 0; i < buffers->size(); ++i) {
        const nlohmann::json& buffer = (*buffers)[i];
        try {
            document.buffers.push_back({load_buffer(document, buffer, i, binary_chunk, compression, warnings), "", ""});
        } catch (const InputError& error) { // nothing may need it
            document.buffers.push_back({{}, error.where, what_of(error)});
            if (buffer.contains("uri")) warnings.add(error.where, document.buffers.back().fault);
        }
    }
}

} // namespace boxwood
