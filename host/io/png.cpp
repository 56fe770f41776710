// SPDX-License-Identifier: MIT
#include <limits>
#include <string>
#include <vector>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC // so that another library's copy does not clash
#define STBI_WRITE_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function" // the formats that are not used here
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

#include "boxwood/error.hpp"
#include "boxwood/image.hpp"
#include "io/atomic_file.hpp"
#include "scene/picture.hpp"

namespace boxwood {

namespace {

void append(void* target, void* bytes, int count) {
    auto& file = *static_cast<std::vector<std::byte>*>(target);
    file.insert(file.end(), static_cast<const std::byte*>(bytes), static_cast<const std::byte*>(bytes) + count);
}

} // namespace

std::vector<std::byte> encode_png(const std::string& name, PictureSize size, std::uint32_t channels,
                                  std::span<const std::uint8_t> pixels) {
    if (size.width == 0 || size.height == 0) throw InputError(name, "", "an image without pixels cannot be written");
    // The encoder counts bytes in int, a filter byte per row included, and its compressed copy may be a little larger.
    constexpr std::uint64_t largest = std::numeric_limits<int>::max() / 2;
    const std::uint64_t row = channels * std::uint64_t{size.width};
    if (row + 1 > largest / size.height) throw InputError(name, "", "the image is too large for PNG");
    if (pixels.size() != row * size.height) {
        throw InputError(name, "",
                         "has " + std::to_string(pixels.size()) + " bytes for " + std::to_string(row * size.height));
    }
    std::vector<std::byte> file;
    const int done = stbi_write_png_to_func(append, &file, static_cast<int>(size.width), static_cast<int>(size.height),
                                            static_cast<int>(channels), pixels.data(), static_cast<int>(row));
    if (done == 0) throw InputError(name, "", "cannot be encoded as PNG: is there enough memory?");
    return file;
}

void save_png(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height,
              std::span<const std::uint8_t> rgb) {
    const std::vector<std::byte> bytes = encode_png(file.string(), {width, height}, 3, rgb);
    AtomicFile out(file);
    out.stream().write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    out.commit();
}

} // namespace boxwood
