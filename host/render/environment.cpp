// SPDX-License-Identifier: MIT
#include "render/environment.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "boxwood/error.hpp"
#include "boxwood/material.hpp"

namespace boxwood {

namespace {

double luminance(const glm::vec3& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

/// `weights`, all >= 0, become a distribution: 0, sums up to each, 1. Where every weight is 0 all are equal. A fraction
/// of 2^-10 is spread over all, so that none that is not 0 rounds to nothing.
void append_distribution(const std::vector<double>& weights, std::vector<float>& out) {
    double total = 0.0;
    for (const double weight : weights) total += weight;
    const double spread = (total > 0.0 ? 0x1p-10 : 1.0) / static_cast<double>(weights.size());
    double sum = 0.0;
    out.push_back(0.0f);
    for (std::size_t i = 0; i < weights.size(); ++i) {
        sum += spread + (total > 0.0 ? (1.0 - 0x1p-10) * weights[i] / total : 0.0);
        out.push_back(i + 1 == weights.size() ? 1.0f : std::min(static_cast<float>(sum), 1.0f));
    }
}

double mean_luminance(const Environment& e) {
    double sum = 0.0;
    for (const glm::vec3& pixel : e.pixels) sum += luminance(pixel);
    return sum / static_cast<double>(e.pixels.size());
}

/// Mean of the luminance above `floor` at the corners of each patch between the centres of four texels, but for the
/// solid angle of its row: height + 1 rows, the first and the last half a texel high. Columns wrap around, rows end.
std::vector<double> patch_means(const Environment& e, float floor) {
    std::vector<double> means;
    means.reserve(std::size_t{e.height + 1} * e.width);
    for (std::size_t y = 0; y <= e.height; ++y) {
        const glm::vec3* above = e.pixels.data() + (y == 0 ? 0 : y - 1) * e.width;
        const glm::vec3* below = e.pixels.data() + std::min<std::size_t>(y, e.height - 1) * e.width;
        for (std::size_t x = 0; x < e.width; ++x) {
            const std::size_t right = (x + 1) % e.width;
            double sum = 0.0;
            for (const glm::vec3& corner : {above[x], above[right], below[x], below[right]})
                sum += std::max(luminance(corner) - double{floor}, 0.0);
            means.push_back(0.25 * sum);
        }
    }
    return means;
}

/// cos(first) - cos(last), without cancellation.
double cosine_difference(double first, double last) {
    return 2.0 * std::sin(0.5 * (last - first)) * std::sin(0.5 * (last + first));
}

double mean(const glm::vec3& c) { return (double{c.x} + c.y + c.z) / 3.0; }

/// Of the light above `floor` over the half of all directions that a surface sees, if it sees as much as the others.
double mean_irradiance(const Environment& e, float floor) {
    if (e.pixels.empty()) return 2.0 * std::numbers::pi * mean(e.radiance);
    double sum = 0.0;
    const double step = std::numbers::pi / e.height;
    for (std::size_t y = 0; y < e.height; ++y) {
        double row = 0.0;
        for (std::size_t x = 0; x < e.width; ++x) {
            const glm::vec3& pixel = e.pixels[y * e.width + x];
            const double light = luminance(pixel);
            if (light > floor) row += mean(pixel) * (1.0 - floor / light);
        }
        sum += row * cosine_difference(static_cast<double>(y) * step, static_cast<double>(y + 1) * step);
    }
    return std::numbers::pi * sum / e.width;
}

struct Distribution {
    std::vector<float> rows, columns;
};

Distribution patch_distribution(const Environment& e, float floor) {
    const std::vector<double> means = patch_means(e, floor);
    Distribution distribution;
    std::vector<double> row_masses(std::size_t{e.height} + 1);
    distribution.columns.reserve(means.size() + e.height + 1);
    for (std::size_t y = 0; y <= e.height; ++y) {
        const auto first = means.begin() + static_cast<std::ptrdiff_t>(y * e.width);
        const std::vector<double> row(first, first + e.width);
        append_distribution(row, distribution.columns);
        const double step = std::numbers::pi / e.height;
        const double top = step * std::max(static_cast<double>(y) - 0.5, 0.0);
        const double bottom = step * std::min(static_cast<double>(y) + 0.5, static_cast<double>(e.height));
        for (const double mean : row) row_masses[y] += mean * cosine_difference(top, bottom);
    }
    append_distribution(row_masses, distribution.rows);
    return distribution;
}

void upload_picture(Device& device, const Environment& e, float floor, EnvironmentMap& map) {
    std::vector<float> texels;
    texels.reserve(3 * e.pixels.size());
    for (const glm::vec3& pixel : e.pixels) texels.insert(texels.end(), {pixel.x, pixel.y, pixel.z});
    map.texels = upload(device, texels, "environment");
    const Distribution all = patch_distribution(e, 0.0f), above = patch_distribution(e, floor);
    map.rows = upload(device, all.rows, "environment rows");
    map.columns = upload(device, all.columns, "environment columns");
    map.rows_above_floor = upload(device, above.rows, "environment rows");
    map.columns_above_floor = upload(device, above.columns, "environment columns");
}

bool is_radiance(const glm::vec3& c) {
    for (int i = 0; i < 3; ++i)
        if (!(c[i] >= 0.0f && c[i] <= largest_radiance)) return false;
    return true;
}

void check_radiance(const Environment& e) {
    const char* const fault = "is not within 0 and 2^60";
    if (!is_radiance(e.radiance)) throw InputError("environment", "radiance", fault);
    const auto wrong = std::find_if_not(e.pixels.begin(), e.pixels.end(), is_radiance);
    if (wrong != e.pixels.end())
        throw InputError("environment", "pixels[" + std::to_string(wrong - e.pixels.begin()) + "]", fault);
}

/// In turns, within [0, 1).
float turn_of(const Environment& e) {
    if (!std::isfinite(e.rotation)) throw InputError("environment", "rotation", "is not finite");
    const double turns = double{e.rotation} / (2.0 * std::numbers::pi);
    const auto turn = static_cast<float>(turns - std::floor(turns));
    return turn < 1.0f ? turn : 0.0f;
}

} // namespace

EnvironmentMap upload_environment(Device& device, const Environment& environment) {
    check_radiance(environment);
    if (environment.pixels.size() != std::size_t{environment.width} * environment.height)
        throw InputError("environment", "pixels",
                         std::to_string(environment.pixels.size()) + " for " + std::to_string(environment.width) +
                             " x " + std::to_string(environment.height));
    EnvironmentMap map;
    const glm::vec3& radiance = environment.radiance;
    const auto bright = [](const glm::vec3& c) { return c.x > 0.0f || c.y > 0.0f || c.z > 0.0f; };
    if (!environment.pixels.empty())
        map.kind = std::any_of(environment.pixels.begin(), environment.pixels.end(), bright) ? EnvironmentKind::picture
                                                                                             : EnvironmentKind::none;
    else
        map.kind = bright(radiance) ? EnvironmentKind::constant : EnvironmentKind::none;
    const float floor = environment.pixels.empty() ? 0.0f : static_cast<float>(mean_luminance(environment));
    const EnvironmentRecord record{{radiance.x, radiance.y, radiance.z},
                                   environment.width,
                                   environment.height,
                                   static_cast<float>(mean_irradiance(environment, 0.0f)),
                                   floor,
                                   static_cast<float>(mean_irradiance(environment, floor)),
                                   turn_of(environment)};
    map.record = upload(device, std::vector<EnvironmentRecord>{record}, "environment record");
    if (map.kind == EnvironmentKind::picture) upload_picture(device, environment, floor, map);
    return map;
}

} // namespace boxwood
