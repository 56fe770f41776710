// SPDX-License-Identifier: MIT
// Whatever the bytes, a picture is decoded to the size that its head says, or refused by an InputError. The first byte
// of an input chooses: 255 is the rest as a file; below that, bytes of a small file are overwritten, three bytes of
// input each: of a JPEG file from 128 on, else of a PNG file.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function" // the formats that are not used here
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

#include "boxwood/error.hpp"
#include "scene/picture.hpp"

using namespace boxwood;

namespace {

constexpr std::uint8_t raw_file = 255, first_jpeg = 128;

void append(void* target, void* bytes, int count) {
    auto& file = *static_cast<std::vector<std::byte>*>(target);
    file.insert(file.end(), static_cast<const std::byte*>(bytes), static_cast<const std::byte*>(bytes) + count);
}

/// More than a block of 8 x 8 pixels of JPEG, and of 16 x 16 where its colours have half the resolution.
std::vector<std::byte> sample(std::uint8_t choice) {
    constexpr std::uint32_t width = 19, height = 17;
    const std::uint32_t channels = 1 + choice % 4;
    std::vector<std::uint8_t> pixels(width * height * channels);
    for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<std::uint8_t>(37 * i);
    if (choice < first_jpeg) return encode_png("sample", {width, height}, channels, pixels);
    std::vector<std::byte> file;
    const int quality = choice % 8 < 4 ? 50 : 95; // half resolution, and full
    if (stbi_write_jpg_to_func(append, &file, width, height, static_cast<int>(channels), pixels.data(), quality) == 0)
        std::abort();
    return file;
}

std::vector<std::byte> edited(std::uint8_t choice, std::span<const std::uint8_t> input) {
    std::vector<std::byte> file = sample(choice);
    for (; input.size() >= 3; input = input.subspan(3))
        file[(input[0] | static_cast<std::size_t>(input[1]) << 8) % file.size()] = std::byte{input[2]};
    return file;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::span<const std::uint8_t> input(data, size);
    if (input.empty()) return 0;
    const std::uint8_t choice = input.front();
    input = input.subspan(1);
    const auto raw = std::as_bytes(input);
    const EncodedImage image{"fuzz", choice == raw_file ? std::vector<std::byte>(raw.begin(), raw.end())
                                                        : edited(choice, input)};
    try {
        const PictureSize head = picture_size(image);
        if (std::uint64_t{head.width} * head.height > 1u << 20) return 0; // for the fuzzer's memory
        const Picture picture = decode_picture(image);
        if (picture.size.width != head.width || picture.size.height != head.height) std::abort();
        if (picture.rgba.size() + picture.rgba16.size() != std::size_t{4} * head.width * head.height) std::abort();
    } catch (const InputError&) {
    }
    return 0;
}
