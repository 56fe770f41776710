// SPDX-License-Identifier: MIT
// PNG files of 16 bits per channel, which the library reads but does not write.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "scene/picture.hpp"

namespace boxwood::test {

/// Of 1 to 4 channels, without compression and, as the decoder does not look at them, check sums.
inline std::vector<std::byte> encode_png16(PictureSize size, std::uint32_t channels,
                                           const std::vector<std::uint16_t>& values) {
    std::vector<std::byte> file;
    const auto add = [&file](std::uint32_t value, int bytes) {
        while (bytes-- > 0) file.push_back(static_cast<std::byte>(value >> (8 * bytes)));
    };
    const auto open = [&](std::size_t length, std::string_view kind) {
        add(static_cast<std::uint32_t>(length), 4);
        for (const char letter : kind) file.push_back(static_cast<std::byte>(letter));
    };
    add(0x89504e47, 4);
    add(0x0d0a1a0a, 4);
    open(13, "IHDR");
    add(size.width, 4);
    add(size.height, 4);
    constexpr std::uint32_t color_types[] = {0, 4, 2, 6};
    add(16, 1);
    add(color_types[channels - 1], 1);
    add(0, 3);
    add(0, 4);
    const std::size_t row = 1 + std::size_t{2} * channels * size.width, stored = size.height * (row + 5);
    open(2 + stored + 4, "IDAT");
    add(0x7801, 2);
    for (std::uint32_t y = 0; y < size.height; ++y) { // a stored block for each row: its length, low byte first
        const auto length = static_cast<std::uint32_t>(row), swapped = (length & 255) << 8 | length >> 8;
        add(y + 1 == size.height ? 1 : 0, 1);
        add(swapped, 2);
        add(~swapped & 0xffff, 2);
        add(0, 1);
        for (std::size_t i = 0; i < std::size_t{channels} * size.width; ++i)
            add(values[y * std::size_t{channels} * size.width + i], 2);
    }
    add(0, 4);
    add(0, 4);
    open(0, "IEND");
    add(0, 4);
    return file;
}

} // namespace boxwood::test
