// SPDX-License-Identifier: MIT
#include <limits>

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

namespace boxwood {

namespace {

void append(void* stream, void* bytes, int count) {
    static_cast<std::ostream*>(stream)->write(static_cast<const char*>(bytes), count);
}

} // namespace

void save_png(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height,
              std::span<const std::uint8_t> rgb) {
    const std::string name = file.string();
    if (width == 0 || height == 0) throw InputError(name, "", "an image without pixels cannot be written");
    // The encoder counts bytes in int, a filter byte per row included, and its compressed copy may be a little larger.
    constexpr std::uint64_t largest = std::numeric_limits<int>::max() / 2;
    const std::uint64_t row = 3 * std::uint64_t{width};
    if (row + 1 > largest / height) throw InputError(name, "", "the image is too large for a PNG preview");
    if (rgb.size() != row * height) {
        throw InputError(name, "", "has " + std::to_string(rgb.size()) + " bytes for " + std::to_string(row * height));
    }
    AtomicFile out(file);
    const int done = stbi_write_png_to_func(append, &out.stream(), static_cast<int>(width), static_cast<int>(height), 3,
                                            rgb.data(), static_cast<int>(row));
    if (done == 0) throw InputError(name, "", "cannot be encoded as PNG: is there enough memory?");
    out.commit();
}

} // namespace boxwood
