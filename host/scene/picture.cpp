// SPDX-License-Identifier: MIT
#include "scene/picture.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string>

namespace {

// A few bytes of a deflate stream may ask for gigabytes, whatever the size of the picture: no block is larger than
// this.
thread_local std::size_t largest_block = 0;

void* allocate(std::size_t bytes) { return bytes <= largest_block ? std::malloc(bytes) : nullptr; }

void* reallocate(void* block, std::size_t bytes) {
    return bytes <= largest_block ? std::realloc(block, bytes) : nullptr;
}

} // namespace

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC // so that another library's copy, with other formats, does not clash
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_MALLOC(bytes) allocate(bytes)
#define STBI_REALLOC(block, bytes) reallocate(block, bytes)
#define STBI_FREE(block) std::free(block)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function" // what is not used here
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

#include "boxwood/error.hpp"
#include "common/excerpt.hpp"

namespace boxwood {

namespace {

constexpr std::size_t smallest_limit = std::size_t{1} << 20;

const stbi_uc* first_byte(const EncodedImage& image) { return reinterpret_cast<const stbi_uc*>(image.bytes.data()); }

/// Whether every Huffman table of a JPEG file has at most 256 codes: stb_image 2.27 writes beyond its own for more.
bool has_sound_tables(std::span<const std::byte> file) {
    std::size_t at = 2;
    // The decoder, too, reads zeros behind the end of the file, and a table whose segment ends within it.
    const auto byte = [&file](std::size_t i) { return i < file.size() ? std::to_integer<unsigned>(file[i]) : 0u; };
    while (at < file.size()) {
        if (byte(at) != 0xff || byte(at + 1) == 0x00 || (byte(at + 1) >= 0xd0 && byte(at + 1) <= 0xd7)) {
            ++at; // coded data, and the marks within
            continue;
        }
        const unsigned marker = byte(at + 1);
        if (marker == 0xd9) return true;
        if (marker == 0xff || marker == 0x01 || marker == 0xd8) {
            at += marker == 0xff ? 1 : 2; // no segment
            continue;
        }
        const std::size_t end = at + 2 + (byte(at + 2) << 8 | byte(at + 3));
        for (std::size_t table = at + 4; marker == 0xc4 && table < end;) {
            std::size_t codes = 0;
            for (std::size_t i = 1; i <= 16; ++i) codes += byte(table + i);
            if (codes > 256) return false;
            table += 17 + codes;
        }
        at = end;
    }
    return true;
}

/// Length of a file that may be given to the decoder.
int byte_count(const EncodedImage& image) {
    if (!picture_format(image.bytes)) throw InputError(excerpt(image.name), "", "is neither PNG nor JPEG");
    if (image.bytes.size() > std::numeric_limits<int>::max())
        throw InputError(excerpt(image.name), "", "is too large a file");
    if (picture_format(image.bytes) == PictureFormat::jpeg && !has_sound_tables(image.bytes))
        throw InputError(excerpt(image.name), "", "cannot be decoded: a table of codes is too long");
    return static_cast<int>(image.bytes.size());
}

[[noreturn]] void fail(const EncodedImage& image) {
    const char* const given = stbi_failure_reason();
    std::string reason = given == nullptr ? "no reason" : given;
    // What it says of a head that none of its decoders takes.
    if (reason == "unknown image type") reason = "its head is broken, or tells of more than 2^30 bytes of pixels";
    if (reason == "outofdata") reason = "it ends early";
    throw InputError(excerpt(image.name), "", "cannot be decoded: " + reason);
}

bool starts_with(std::span<const std::byte> file, std::span<const std::uint8_t> signature) {
    return file.size() >= signature.size() &&
           std::equal(signature.begin(), signature.end(), file.begin(),
                      [](std::uint8_t a, std::byte b) { return a == std::to_integer<std::uint8_t>(b); });
}

} // namespace

std::optional<PictureFormat> picture_format(std::span<const std::byte> file) {
    static constexpr std::array<std::uint8_t, 8> png = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    static constexpr std::array<std::uint8_t, 3> jpeg = {0xff, 0xd8, 0xff};
    if (starts_with(file, png)) return PictureFormat::png;
    if (starts_with(file, jpeg)) return PictureFormat::jpeg;
    return std::nullopt;
}

PictureSize picture_size(const EncodedImage& image) {
    const int bytes = byte_count(image);
    int width = 0, height = 0, channels = 0;
    largest_block = smallest_limit;
    if (stbi_info_from_memory(first_byte(image), bytes, &width, &height, &channels) == 0) fail(image);
    if (width <= 0 || height <= 0) throw InputError(excerpt(image.name), "", "has no pixels");
    return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
}

bool is_wide(const EncodedImage& image) {
    if (picture_format(image.bytes) != PictureFormat::png) return false;
    largest_block = smallest_limit;
    const std::size_t head = std::min<std::size_t>(image.bytes.size(), smallest_limit);
    return stbi_is_16_bit_from_memory(first_byte(image), static_cast<int>(head)) != 0;
}

namespace {

/// By one of the decoder's functions, all pixels.
template <class T, class Load>
void decode(const EncodedImage& image, int bytes, Load load, std::vector<T>& rgba) {
    int width = 0, height = 0, channels = 0;
    const std::unique_ptr<T, void (*)(void*)> pixels(load(first_byte(image), bytes, &width, &height, &channels, 4),
                                                     stbi_image_free);
    if (pixels == nullptr) fail(image);
    rgba.assign(pixels.get(), pixels.get() + std::size_t{4} * static_cast<std::size_t>(width) * height);
}

} // namespace

Picture decode_picture(const EncodedImage& image) {
    const int bytes = byte_count(image);
    const PictureSize size = picture_size(image);
    const bool wide = is_wide(image);
    // The most that a decoder needs: 8 bytes a pixel and a filter byte a row, grown by doubling; the file, for its
    // packed data.
    largest_block = smallest_limit + image.bytes.size() + std::size_t{32} * size.width * size.height;
    Picture picture{size, {}};
    if (wide)
        decode(image, bytes, stbi_load_16_from_memory, picture.rgba16);
    else
        decode(image, bytes, stbi_load_from_memory, picture.rgba);
    return picture;
}

} // namespace boxwood
