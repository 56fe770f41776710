// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <glm/glm.hpp>

#include "bsdf_draws.hpp"
#include "path_scenes.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("render");

namespace {

/// Centres of the cells of a grid over cosine and azimuth: all stand for the same solid angle.
std::vector<glm::vec3> hemisphere_grid(int across) {
    std::vector<glm::vec3> directions;
    for (int j = 0; j < across; ++j)
        for (int i = 0; i < across; ++i) {
            const double z = (j + 0.5) / across, phi = 2 * pi * (i + 0.5) / across, r = std::sqrt(1 - z * z);
            directions.emplace_back(r * std::cos(phi), r * std::sin(phi), z);
        }
    return directions;
}

const std::array<Programs, 4> all_programs = {Programs{true, false}, {true, true}, {false, false}, {false, true}};

} // namespace

TEST_CASE("bsdf: what is drawn has the density that is told, which integrates to 1") {
    const int across = small_sizes() ? 24 : 256;
    const std::uint32_t count = small_sizes() ? 256 : 1 << 16;
    const std::vector<glm::vec3> grid = hemisphere_grid(across);
    for (const Programs& programs : all_programs)
        for (const float roughness : {small_sizes() ? 0.8f : 0.4f, 1.0f}) // the grid does not resolve narrower lobes
            for (const double cosine : {1.0, 0.6, 0.1}) {
                CAPTURE(programs.specular);
                CAPTURE(programs.uniform);
                CAPTURE(roughness);
                CAPTURE(cosine);
                const Matter matter{{0.9f, 0.5f, 0.2f}, 0.3f, roughness, 0.8f};
                const glm::vec3 wo = at_cosine(cosine);
                // Means of 1, x, z, z^2 and x z over what is drawn above the surface.
                std::array<double, 5> drawn{}, expected{};
                double below = 0.0;
                int misjudged = 0;
                const auto add = [](std::array<double, 5>& sums, const glm::dvec3& w, double weight) {
                    const double values[] = {1, w.x, w.z, w.z * w.z, w.x * w.z};
                    for (int k = 0; k < 5; ++k) sums[k] += weight * values[k];
                };
                for (const Drawn& d : draw(programs, matter, wo, count)) {
                    if (d.wi.z > 0)
                        add(drawn, d.wi, 1.0 / count);
                    else
                        below += 1.0 / count;
                    if ((d.pdf > 0) != (d.wi.z > 0)) ++misjudged;
                }
                CHECK(misjudged == 0);
                const std::vector<glm::dvec4> values = evaluate(programs, matter, wo, grid);
                for (std::size_t i = 0; i < grid.size(); ++i)
                    add(expected, grid[i], values[i].w * 2 * pi / double(grid.size()));
                // Cells of the grid that the horizon of the half vectors cuts, and one coordinate that takes the lobe.
                const double tolerance = small_sizes() ? 0.1 : 5e-3;
                CHECK(std::abs(expected[0] + below - 1.0) < tolerance);
                for (int k = 0; k < 5; ++k) CHECK(std::abs(drawn[k] - expected[k]) < tolerance);
            }
}

TEST_CASE("bsdf: the mean of value over density is the integral of the value") {
    const int across = small_sizes() ? 24 : 256;
    const std::uint32_t count = small_sizes() ? 1024 : 1 << 16;
    const std::vector<glm::vec3> grid = hemisphere_grid(across);
    for (const Programs& programs : all_programs)
        for (const float metallic : {0.0f, 0.5f, 1.0f})
            for (const double cosine : {0.9, 0.2}) {
                CAPTURE(programs.specular);
                CAPTURE(metallic);
                CAPTURE(cosine);
                const Matter matter{{0.9f, 0.5f, 0.2f}, metallic, 0.5f, 1.0f};
                const glm::vec3 wo = at_cosine(cosine);
                glm::dvec3 mean(0.0), integral(0.0);
                for (const Drawn& d : draw(programs, matter, wo, count))
                    if (d.pdf > 0) mean += d.value / d.pdf / double(count);
                for (const glm::dvec4& v : evaluate(programs, matter, wo, grid))
                    integral += glm::dvec3(v) * 2.0 * pi / double(grid.size());
                for (int c = 0; c < 3; ++c) CHECK(std::abs(mean[c] - integral[c]) < (small_sizes() ? 0.1 : 4e-3));
                // Single scattering loses light and makes none.
                CHECK(integral.x < 1.0 + 1e-3);
            }
}

TEST_CASE("bsdf: swapping the directions changes nothing but the cosine") {
    const int across = small_sizes() ? 4 : 16;
    const std::vector<glm::vec3> grid = hemisphere_grid(across);
    for (const float roughness : {0.0f, 0.3f, 1.0f}) {
        const Matter matter{{0.9f, 0.5f, 0.2f}, 0.4f, roughness, 0.7f};
        const glm::vec3 wo = at_cosine(0.35);
        std::vector<Seen> swapped;
        std::vector<glm::vec3> turned;
        for (const glm::vec3& wi : grid) {
            // wo has y = 0: both are turned about z.
            const float length = std::hypot(wi.x, wi.y);
            turned.emplace_back(wi.x * wo.x / length, -wi.y * wo.x / length, wo.z);
            swapped.push_back(seen(matter, at_cosine(wi.z)));
        }
        const std::vector<glm::dvec4> one = evaluate({}, matter, wo, grid), other = evaluate({}, swapped, turned);
        for (std::size_t i = 0; i < grid.size(); ++i) {
            for (int c = 0; c < 3; ++c) {
                const double a = one[i][c] / grid[i].z, b = other[i][c] / wo.z;
                // The narrowest lobe multiplies the roundings of the turned vector by the inverse of its width.
                CHECK(std::abs(a - b) <= (roughness == 0.0f ? 1e-2 : 1e-4) * std::max(a, b));
            }
        }
    }
}

TEST_CASE("bsdf: a white Lambert surface returns all light") {
    const std::uint32_t count = small_sizes() ? 256 : 1 << 14;
    for (const bool uniform : {false, true})
        for (const bool specular : {false, true})
            for (const double cosine : {1.0, 0.3, 0.01}) {
                CAPTURE(uniform);
                CAPTURE(cosine);
                const Matter matter{glm::vec3(1.0f), 0.0f, 0.5f, 0.0f};
                double mean = 0.0;
                for (const Drawn& d : draw({specular, uniform}, matter, at_cosine(cosine), count))
                    if (d.pdf > 0) mean += d.value.y / d.pdf / count;
                CHECK(std::abs(mean - 1.0) < (uniform && small_sizes() ? 0.05 : 2e-3));
            }
}

TEST_CASE("bsdf: a white GGX surface loses what single scattering loses") {
    const int across = small_sizes() ? 128 : 512;
    const std::uint32_t count = small_sizes() ? 256 : 1 << 15;
    for (const float roughness : {0.0f, 0.01f, 0.03f, 0.1f, 0.3f, 0.6f, 1.0f})
        for (const double cosine : {1.0, 0.7, 0.2, 0.05}) {
            CAPTURE(roughness);
            CAPTURE(cosine);
            double mean = 0.0;
            for (const Drawn& d : draw({}, {glm::vec3(1.0f), 1.0f, roughness, 1.0f}, at_cosine(cosine), count))
                if (d.pdf > 0) mean += d.value.y / d.pdf / count;
            const double expected =
                ggx_albedo(cosine, std::max<double>(double(roughness) * roughness, 0x1p-13), across);
            CHECK(std::abs(mean - expected) < (small_sizes() ? 0.05 : 2e-3));
        }
}

TEST_CASE("bsdf: nothing infinite at any angle and roughness") {
    std::vector<glm::vec3> directions;
    for (const double z : {1.0, 0.5, 1e-3, 1e-6, 1e-12, 1e-20, 1e-30, 1e-38, 1e-42, 0.0, -1e-42, -0.5})
        for (const double sign : {-1.0, 1.0}) directions.push_back(glm::vec3(sign, 1, 1) * at_cosine(z));
    std::vector<Seen> seen_to, seen_from;
    std::vector<glm::vec3> towards;
    std::vector<Point> points;
    for (const float roughness : {0.0f, 1e-20f, 0.01f, 1.0f})
        for (const float metallic : {0.0f, 1.0f})
            for (const double cosine : {1.0, 0.5, 1e-3, 1e-6, 1e-12, 1e-20, 1e-38, 1e-42, 0.0, -1e-42, -1e-3, -1.0})
                for (const glm::vec3& color : {glm::vec3(0.0f), glm::vec3(1.0f)}) {
                    const Seen surface = seen({color, metallic, roughness, metallic}, at_cosine(cosine));
                    for (const glm::vec3& d : directions) {
                        seen_to.push_back(surface);
                        towards.push_back(d);
                    }
                    for (Point p : sequence(small_sizes() ? 4 : 64)) {
                        const auto corner = points.size() % 8; // some at the corners of the square
                        if (corner < 4)
                            p = {p[0], corner % 2 ? 0x1.fffffep-1f : 0.0f, corner / 2 ? 0x1.fffffep-1f : 0.0f};
                        seen_from.push_back(surface);
                        points.push_back(p);
                    }
                }
    int wrong = 0;
    const std::vector<glm::dvec4> values = evaluate({}, seen_to, towards);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const bool above = seen_to[i][7] > 0 && towards[i].z > 0;
        for (int k = 0; k < 4; ++k)
            if (!(values[i][k] >= 0.0 && std::isfinite(values[i][k]) && (above || values[i][k] == 0.0))) ++wrong;
    }
    CHECK(wrong == 0);
    for (const Drawn& d : draw({}, seen_from, points)) {
        const double length = glm::length(d.wi);
        if (!(length > 1 - 1e-6 && length < 1 + 1e-6)) ++wrong;
        if (!(d.pdf >= 0.0 && std::isfinite(d.pdf + d.value.x + d.value.y + d.value.z))) ++wrong;
    }
    CHECK(wrong == 0);
}
