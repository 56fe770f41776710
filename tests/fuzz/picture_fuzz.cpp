// SPDX-License-Identifier: MIT
// Whatever the bytes, a picture is decoded to the size that its head says, or refused by an InputError.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "boxwood/error.hpp"
#include "io/picture.hpp"

using namespace boxwood;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto bytes = std::as_bytes(std::span(data, size));
    const EncodedImage image{"fuzz", {bytes.begin(), bytes.end()}};
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
