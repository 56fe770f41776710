// SPDX-License-Identifier: MIT
// Eight-bit previews of rendered images.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include <glm/glm.hpp>

#include "boxwood/error.hpp"
#include "boxwood/render.hpp"

namespace boxwood {

namespace {

template <class T>
const std::vector<T>& channel(const Image& image, const std::string& name) {
    for (const Channel& each : image.channels)
        if (each.name == name)
            if (const auto* samples = std::get_if<std::vector<T>>(&each.samples)) {
                const std::uint64_t pixels = std::uint64_t{image.width} * image.height;
                if (samples->size() == pixels) return *samples;
                throw InputError("image", name,
                                 "has " + std::to_string(samples->size()) + " samples for " + std::to_string(pixels) +
                                     " pixels");
            }
    throw InputError("image", name, "the preview needs this channel");
}

/// Linear light, clamped to [0, 1] (NaN to 0), to an sRGB byte (IEC 61966-2-1).
std::uint8_t srgb_byte(double linear) {
    const double value = linear > 0.0 ? std::min(linear, 1.0) : 0.0;
    const double encoded = value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255.0 * encoded));
}

/// Khronos PBR Neutral (its specification, 2024): what reflection at a dielectric's surface adds is taken off, and
/// above 0.76 brightness is compressed towards 1 and colours fade to white.
glm::dvec3 neutral_curve(glm::dvec3 colour) {
    constexpr double start = 0.8 - 0.04, desaturation = 0.15, room = 1.0 - start;
    const double least = std::min({colour.x, colour.y, colour.z});
    colour -= least < 0.08 ? least - 6.25 * least * least : 0.04;
    const double peak = std::max({colour.x, colour.y, colour.z});
    if (peak < start) return colour;
    const double compressed = 1.0 - room * room / (peak + room - start);
    const double faded = 1.0 - 1.0 / (desaturation * (peak - compressed) + 1.0);
    return glm::mix(colour * (compressed / peak), glm::dvec3(compressed), faded);
}

/// Oklab to linear sRGB (Ottosson, "A perceptual color space for image processing", 2020; his two matrices).
glm::dvec3 from_oklab(double lightness, double a, double b) {
    const glm::dvec3 root(lightness + 0.3963377774 * a + 0.2158037573 * b,
                          lightness - 0.1055613458 * a - 0.0638541728 * b,
                          lightness - 0.0894841775 * a - 1.2914855480 * b);
    const glm::dvec3 cone = root * root * root;
    return {4.0767416621 * cone.x - 3.3077115913 * cone.y + 0.2309699292 * cone.z,
            -1.2684380046 * cone.x + 2.6097574011 * cone.y - 0.3413193965 * cone.z,
            -0.0041960863 * cone.x - 0.7034186147 * cone.y + 1.7076147010 * cone.z};
}

/// The map at `x` in [0, 1]. Lightness in Oklab rises in proportion to x, so that equal steps of cost look equal, also
/// in grey; the hue turns from blue through red to yellow, the order in which those hues grow lighter, so that each is
/// met near the lightness where sRGB holds it most saturated; chroma falls to nothing at the dark end and to a pale
/// yellow at the bright one, where sRGB has little room.
glm::dvec3 heat(double x) {
    const double lightness = 0.12 + 0.84 * x;
    const double turn = -100.0 + 205.0 * x; // degrees: 260 (blue) over 0 (magenta red) to 105 (yellow)
    const double hue = turn * std::numbers::pi / 180.0;
    const double chroma = 0.19 * std::sin(std::numbers::pi * std::pow(0.06 + 0.82 * x, 0.8));
    return from_oklab(lightness, chroma * std::cos(hue), chroma * std::sin(hue));
}

constexpr int heat_steps = 256;

std::array<std::array<std::uint8_t, 3>, heat_steps> heat_table() {
    std::array<std::array<std::uint8_t, 3>, heat_steps> table;
    for (int i = 0; i < heat_steps; ++i) {
        const glm::dvec3 colour = heat(static_cast<double>(i) / (heat_steps - 1));
        table[i] = {srgb_byte(colour.x), srgb_byte(colour.y), srgb_byte(colour.z)};
    }
    return table;
}

/// The value that 99.5 % of the elements do not pass, so that a few silhouette pixels do not darken all others.
std::uint32_t top_of(std::vector<std::uint32_t> values) {
    if (values.empty()) return 0;
    const auto rank = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) * 995 / 1000);
    std::nth_element(values.begin(), rank, values.end());
    return *rank;
}

/// The value that `fraction` of the elements do not pass.
double percentile(std::vector<double>& values, double fraction) {
    const auto rank = values.begin() + static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), rank, values.end());
    return *rank;
}

} // namespace

std::vector<std::uint8_t> preview(const Image& image, const PreviewOptions& options) {
    const std::array planes = {&channel<float>(image, "R"), &channel<float>(image, "G"), &channel<float>(image, "B")};
    const double scale = std::exp2(double{options.exposure});
    // Far above white, and far from where squares of doubles end.
    constexpr double most = 1e30;
    std::vector<std::uint8_t> rgb;
    rgb.reserve(3 * planes[0]->size());
    for (std::size_t i = 0; i < planes[0]->size(); ++i) {
        glm::dvec3 colour;
        for (int c = 0; c < 3; ++c) {
            const double light = scale * double{(*planes[static_cast<std::size_t>(c)])[i]};
            colour[c] = light > 0.0 ? std::min(light, most) : 0.0; // NaN to 0
        }
        if (options.tone_curve) colour = neutral_curve(colour);
        for (int c = 0; c < 3; ++c) rgb.push_back(srgb_byte(colour[c]));
    }
    return rgb;
}

float suitable_exposure(const Image& image) {
    const auto &r = channel<float>(image, "R"), &g = channel<float>(image, "G"), &b = channel<float>(image, "B");
    std::vector<double> lit;
    for (std::size_t i = 0; i < r.size(); ++i) {
        const double luminance = 0.2126 * double{r[i]} + 0.7152 * double{g[i]} + 0.0722 * double{b[i]};
        if (luminance > 0.0 && std::isfinite(luminance)) lit.push_back(luminance);
    }
    if (lit.empty()) return 0.0f;
    constexpr double middle = 0.3;
    return static_cast<float>(std::log2(middle) -
                              0.5 * (std::log2(percentile(lit, 0.5)) + std::log2(percentile(lit, 0.9))));
}

HeatMap cost_preview(const Image& image) {
    const std::vector<std::uint32_t>& volumes = channel<std::uint32_t>(image, "cost.volumes");
    const auto table = heat_table();
    HeatMap map;
    map.top = top_of(volumes);
    map.rgb.reserve(3 * volumes.size());
    for (const std::uint32_t count : volumes) {
        const std::uint64_t clamped = std::min(count, map.top);
        const auto& colour = table[map.top == 0 ? 0 : clamped * (heat_steps - 1) / map.top];
        map.rgb.insert(map.rgb.end(), colour.begin(), colour.end());
    }
    return map;
}

} // namespace boxwood
