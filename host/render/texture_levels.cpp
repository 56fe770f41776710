// SPDX-License-Identifier: MIT
#include "render/texture_levels.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace boxwood {

namespace {

double linear_of_srgb(double s) { return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4); }

/// Between codes of 8 or 16 bits and linear values, of one channel.
struct Encoding {
    std::vector<float> linear;
    std::vector<float> midway; ///< Linear value from which on the next code is nearer.

    Encoding(bool srgb, std::size_t codes) : linear(codes), midway(codes - 1) {
        const double largest = static_cast<double>(codes - 1);
        for (std::size_t i = 0; i < linear.size(); ++i) {
            const double code = static_cast<double>(i) / largest, next = (static_cast<double>(i) + 0.5) / largest;
            linear[i] = static_cast<float>(srgb ? linear_of_srgb(code) : code);
            if (i < midway.size()) midway[i] = static_cast<float>(srgb ? linear_of_srgb(next) : next);
        }
    }
    std::uint32_t code(float value) const {
        return static_cast<std::uint32_t>(std::upper_bound(midway.begin(), midway.end(), value) - midway.begin());
    }
};

template <class Code>
const Encoding& encoding(bool srgb) {
    constexpr std::size_t codes = std::size_t{1} << (8 * sizeof(Code));
    static const Encoding plain(false, codes), encoded(true, codes);
    return srgb ? encoded : plain;
}

/// One level, linear.
struct Level {
    PictureSize size;
    std::vector<glm::vec4> texels;
};

PictureSize half(PictureSize size) { return {std::max(1u, size.width / 2), std::max(1u, size.height / 2)}; }

/// What a texel of the smaller level covers along one axis of the larger: at most 3 texels.
struct Cover {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    std::array<float, 3> weights{}; ///< They sum to 1.
};

std::vector<Cover> covers(std::uint32_t large, std::uint32_t small) {
    std::vector<Cover> result(small);
    for (std::uint64_t i = 0; i < small; ++i) {
        Cover& cover = result[i];
        const std::uint64_t begin = i * large, end = begin + large; // in units of 1 / small of a texel
        cover.first = static_cast<std::uint32_t>(begin / small);
        for (std::uint64_t j = cover.first; j * small < end; ++j) {
            const std::uint64_t overlap = std::min(end, (j + 1) * small) - std::max(begin, j * small);
            cover.weights[cover.count++] = static_cast<float>(static_cast<double>(overlap) / large);
        }
    }
    return result;
}

/// `at(x, y)` gives the texels of the larger level.
template <class At>
Level shrink(PictureSize from, At at) {
    Level level{half(from), {}};
    const std::vector<Cover> columns = covers(from.width, level.size.width);
    const std::vector<Cover> rows = covers(from.height, level.size.height);
    level.texels.reserve(std::size_t{level.size.width} * level.size.height);
    for (const Cover& row : rows)
        for (const Cover& column : columns) {
            glm::vec4 sum(0.0f);
            for (std::uint32_t y = 0; y < row.count; ++y)
                for (std::uint32_t x = 0; x < column.count; ++x)
                    sum += row.weights[y] * column.weights[x] * at(column.first + x, row.first + y);
            level.texels.push_back(sum);
        }
    return level;
}

/// R in the lowest bits of the first word.
template <class Code>
void append(const std::array<std::uint32_t, 4>& codes, std::vector<std::uint32_t>& words) {
    constexpr std::size_t bits = 8 * sizeof(Code), in_a_word = 32 / bits;
    for (std::size_t c = 0; c < 4; c += in_a_word) {
        std::uint32_t word = 0;
        for (std::size_t i = 0; i < in_a_word; ++i) word |= codes[c + i] << (bits * i);
        words.push_back(word);
    }
}

template <class Code>
void append(const Level& level, bool srgb, std::vector<std::uint32_t>& words) {
    const Encoding &color = encoding<Code>(srgb), &plain = encoding<Code>(false);
    for (const glm::vec4& texel : level.texels)
        append<Code>({color.code(texel.r), color.code(texel.g), color.code(texel.b), plain.code(texel.a)}, words);
}

template <class Code>
std::vector<std::uint32_t> levels_of(PictureSize size, const std::vector<Code>& rgba, bool srgb) {
    std::vector<std::uint32_t> words;
    words.reserve(level_texels(size) * sizeof(Code));
    for (std::size_t i = 0; i < rgba.size(); i += 4)
        append<Code>({rgba[i], rgba[i + 1], rgba[i + 2], rgba[i + 3]}, words);
    const std::uint32_t levels = level_count(size);
    if (levels == 1) return words;
    const std::vector<float>&color = encoding<Code>(srgb).linear, &plain = encoding<Code>(false).linear;
    Level level = shrink(size, [&](std::uint32_t x, std::uint32_t y) {
        const Code* p = &rgba[4 * (std::size_t{y} * size.width + x)];
        return glm::vec4(color[p[0]], color[p[1]], color[p[2]], plain[p[3]]);
    });
    append<Code>(level, srgb, words);
    for (std::uint32_t i = 2; i < levels; ++i) {
        level = shrink(level.size, [&level](std::uint32_t x, std::uint32_t y) {
            return level.texels[std::size_t{y} * level.size.width + x];
        });
        append<Code>(level, srgb, words);
    }
    return words;
}

template <class Code>
glm::dvec3 mean_of(const std::vector<Code>& rgba, bool srgb) {
    const std::vector<float>& linear = encoding<Code>(srgb).linear;
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < rgba.size(); i += 4)
        sum += glm::dvec3(linear[rgba[i]], linear[rgba[i + 1]], linear[rgba[i + 2]]);
    return sum / std::max(1.0, static_cast<double>(rgba.size() / 4));
}

} // namespace

std::uint32_t level_count(PictureSize size) {
    return static_cast<std::uint32_t>(std::bit_width(std::max(size.width, size.height)));
}

std::uint64_t level_texels(PictureSize size) {
    std::uint64_t texels = 0;
    const std::uint32_t levels = level_count(size);
    for (std::uint32_t level = 0; level < levels; ++level, size = half(size))
        texels += std::uint64_t{size.width} * size.height;
    return texels;
}

std::vector<std::uint32_t> texture_levels(const Picture& picture, bool srgb) {
    return picture.rgba16.empty() ? levels_of(picture.size, picture.rgba, srgb)
                                  : levels_of(picture.size, picture.rgba16, srgb);
}

glm::dvec3 mean_color(const Picture& picture, bool srgb) {
    return picture.rgba16.empty() ? mean_of(picture.rgba, srgb) : mean_of(picture.rgba16, srgb);
}

} // namespace boxwood
