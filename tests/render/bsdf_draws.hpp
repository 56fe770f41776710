// SPDX-License-Identifier: MIT
// The surface model of cl/render/bsdf.h by itself: what it gives for directions, and what it draws.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <glm/glm.hpp>

#include "bounds/lanes_of.hpp"

namespace boxwood::test {

inline constexpr double pi = std::numbers::pi;

struct Matter {
    glm::vec3 base_color{1.0f};
    float metallic = 0.0f, roughness = 0.5f, specular = 1.0f;
};

/// A material and where it is seen from, wo having y = 0.
using Seen = std::array<float, 8>;

inline Seen seen(const Matter& m, const glm::vec3& wo) {
    return {m.base_color.x, m.base_color.y, m.base_color.z, m.metallic, m.roughness, m.specular, wo.x, wo.z};
}

using Point = std::array<float, 3>;

struct Programs {
    bool specular = true, uniform = false;

    Defines defines() const {
        return {{"SPECULAR", specular ? "1" : "0"}, {"UNIFORM_HEMISPHERE", uniform ? "1" : "0"}};
    }
};

inline glm::vec3 at_cosine(double z) { return {std::sqrt(std::max(0.0, 1 - z * z)), 0.0, z}; }

/// Value and density of each direction.
inline std::vector<glm::dvec4> evaluate(const Programs& programs, const std::vector<Seen>& surfaces,
                                        const std::vector<glm::vec3>& directions) {
    std::vector<Point> points;
    for (const glm::vec3& d : directions) points.push_back({d.x, d.y, d.z});
    std::vector<glm::dvec4> result;
    for (const auto& v : in_lanes({"render/bsdf_test.cl", "evaluate_test", programs.defines()},
                                  std::vector<std::array<float, 4>>(points.size()), surfaces, points))
        result.emplace_back(v[0], v[1], v[2], v[3]);
    return result;
}

inline std::vector<glm::dvec4> evaluate(const Programs& programs, const Matter& matter, const glm::vec3& wo,
                                        const std::vector<glm::vec3>& directions) {
    return evaluate(programs, std::vector<Seen>(directions.size(), seen(matter, wo)), directions);
}

struct Drawn {
    glm::dvec3 wi, value;
    double pdf;
};

/// Kronecker's sequence with the cubic plastic number (Roberts 2018).
inline std::vector<Point> sequence(std::uint32_t count) {
    std::vector<Point> points(count);
    const double g = 1.2207440846057596; // g^4 = g + 1
    for (std::uint32_t i = 0; i < count; ++i)
        for (int k = 0; k < 3; ++k) {
            const double x = 0.5 + (i + 1.0) * std::pow(g, -k - 1);
            points[i][k] = std::min(float(x - std::floor(x)), 0x1.fffffep-1f);
        }
    return points;
}

/// A direction for each surface and point.
inline std::vector<Drawn> draw(const Programs& programs, const std::vector<Seen>& surfaces,
                               const std::vector<Point>& points) {
    std::vector<Drawn> result;
    for (const auto& v : in_lanes({"render/bsdf_test.cl", "sample_test", programs.defines()},
                                  std::vector<std::array<float, 7>>(points.size()), surfaces, points))
        result.push_back({{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, v[6]});
    return result;
}

inline std::vector<Drawn> draw(const Programs& programs, const Matter& matter, const glm::vec3& wo,
                               std::uint32_t count) {
    return draw(programs, std::vector<Seen>(count, seen(matter, wo)), sequence(count));
}

} // namespace boxwood::test
