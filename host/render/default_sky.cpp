// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>

#include "boxwood/environment.hpp"

namespace boxwood {

namespace {

const glm::vec3 horizon(0.86f, 0.94f, 1.02f);

/// Radiance from a normalised direction that is not below the horizon: bluer and darker towards the zenith, brighter
/// and warmer around the sun, in the manner of a clear sky's gradation and indicatrix (CIE S 011/E), not to its
/// numbers.
glm::vec3 sky_radiance(const glm::vec3& direction, const glm::vec3& sun) {
    const float haze = std::pow(1.0f - std::max(direction.y, 0.0f), 4.0f);
    const glm::vec3 zenith(0.18f, 0.34f, 0.72f);
    const float facing = std::max(glm::dot(direction, sun), 0.0f);
    const float glow = std::pow(facing, 8.0f) + 4.0f * std::pow(facing, 128.0f);
    return glm::mix(zenith, horizon, haze) + 0.3f * glow * glm::vec3(1.0f, 0.86f, 0.66f);
}

/// The same from below: a plain of dry ground, of which some 2.8 of irradiance from this sky make as much, that fades
/// into the horizon with its distance, which goes by 1 / -y.
glm::vec3 ground_radiance(const glm::vec3& direction) {
    const glm::vec3 ground(0.235f, 0.205f, 0.165f);
    return glm::mix(horizon, ground, std::exp(0.035f / direction.y));
}

} // namespace

Environment default_sky() {
    constexpr std::uint32_t height = 128, width = 2 * height;
    const glm::vec3 sun = glm::normalize(glm::vec3(0.5f, 0.75f, 0.45f));
    const glm::vec3 disc = glm::vec3(1.0f, 0.9f, 0.75f) * 600.0f;
    const float disc_cosine = std::cos(0.03f); // wider than the sun's 0.0047, so that some texels are inside
    Environment sky;
    sky.width = width;
    sky.height = height;
    sky.pixels.reserve(std::size_t{width} * height);
    for (std::uint32_t y = 0; y < height; ++y) {
        const double theta = std::numbers::pi * (y + 0.5) / height;
        for (std::uint32_t x = 0; x < width; ++x) {
            const double phi = 2.0 * std::numbers::pi * (x + 0.5) / width - std::numbers::pi;
            const glm::vec3 direction(std::sin(theta) * std::cos(phi), std::cos(theta),
                                      std::sin(theta) * std::sin(phi));
            glm::vec3 radiance = direction.y < 0.0f ? ground_radiance(direction) : sky_radiance(direction, sun);
            if (glm::dot(direction, sun) > disc_cosine) radiance += disc;
            sky.pixels.push_back(radiance);
        }
    }
    return sky;
}

} // namespace boxwood
