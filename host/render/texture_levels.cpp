// SPDX-License-Identifier: MIT
#include "render/texture_levels.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace boxwood {

namespace {

double linear_of_srgb(double s) { return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4); }

/// Between 8 bits and linear values, of one channel.
struct Encoding {
    std::array<float, 256> linear{};
    std::array<float, 255> midway{}; ///< Linear value from which on the next code is nearer.

    explicit Encoding(bool srgb) {
        for (std::size_t i = 0; i < linear.size(); ++i) {
            const double code = static_cast<double>(i) / 255.0, next = (static_cast<double>(i) + 0.5) / 255.0;
            linear[i] = static_cast<float>(srgb ? linear_of_srgb(code) : code);
            if (i < midway.size()) midway[i] = static_cast<float>(srgb ? linear_of_srgb(next) : next);
        }
    }
    std::uint32_t code(float value) const {
        return static_cast<std::uint32_t>(std::upper_bound(midway.begin(), midway.end(), value) - midway.begin());
    }
};

const Encoding& encoding(bool srgb) {
    static const Encoding plain(false), encoded(true);
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

void append(const Level& level, bool srgb, std::vector<std::uint32_t>& texels) {
    const Encoding& color = encoding(srgb);
    for (const glm::vec4& texel : level.texels)
        texels.push_back(color.code(texel.r) | color.code(texel.g) << 8 | color.code(texel.b) << 16 |
                         encoding(false).code(texel.a) << 24);
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
    std::vector<std::uint32_t> texels;
    texels.reserve(level_texels(picture.size));
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
        const std::uint8_t* p = &picture.rgba[i];
        texels.push_back(std::uint32_t{p[0]} | std::uint32_t{p[1]} << 8 | std::uint32_t{p[2]} << 16 |
                         std::uint32_t{p[3]} << 24);
    }
    const std::uint32_t levels = level_count(picture.size);
    if (levels == 1) return texels;
    const std::array<float, 256>&color = encoding(srgb).linear, &plain = encoding(false).linear;
    Level level = shrink(picture.size, [&](std::uint32_t x, std::uint32_t y) {
        const std::uint8_t* p = &picture.rgba[4 * (std::size_t{y} * picture.size.width + x)];
        return glm::vec4(color[p[0]], color[p[1]], color[p[2]], plain[p[3]]);
    });
    append(level, srgb, texels);
    for (std::uint32_t i = 2; i < levels; ++i) {
        level = shrink(level.size, [&level](std::uint32_t x, std::uint32_t y) {
            return level.texels[std::size_t{y} * level.size.width + x];
        });
        append(level, srgb, texels);
    }
    return texels;
}

glm::dvec3 mean_color(const Picture& picture, bool srgb) {
    const std::array<float, 256>& linear = encoding(srgb).linear;
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
        sum += glm::dvec3(linear[picture.rgba[i]], linear[picture.rgba[i + 1]], linear[picture.rgba[i + 2]]);
    return sum / std::max(1.0, static_cast<double>(picture.rgba.size() / 4));
}

} // namespace boxwood
