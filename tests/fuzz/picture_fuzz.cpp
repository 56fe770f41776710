// SPDX-License-Identifier: MIT
// Whatever the bytes, a picture is decoded to the size that its head says, or refused by an InputError. The first byte of an
// input chooses: 255 is the rest as a file; below that, bytes of a small PNG file are overwritten, three bytes of input each.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "boxwood/error.hpp"
#include "io/picture.hpp"

using namespace boxwood;

namespace {

constexpr std::uint8_t raw_file = 255;

std::vector<std::byte> edited(std::uint32_t channels, std::span<const std::uint8_t> input) {
    std::vector<std::uint8_t> pixels(7 * 5 * channels);
    for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<std::uint8_t>(37 * i);
    std::vector<std::byte> file = encode_png("sample", {7, 5}, channels, pixels);
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
                                                        : edited(1 + choice % 4, input)};
    try {
        const PictureSize head = picture_size(image);
        if (std::uint64_t{head.width} * head.height > 1u << 20) return 0; // for the fuzzer's memory
        const Picture picture = decode_picture(image);
        if (picture.size.width != head.width || picture.size.height != head.height) std::abort();
        if (picture.rgba.size() != std::size_t{4} * head.width * head.height) std::abort();
    } catch (const InputError&) {
    }
    return 0;
}
