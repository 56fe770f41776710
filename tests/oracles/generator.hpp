// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

namespace boxwood::test {

/// Small deterministic generator (splitmix64) for what tests and benchmarks share, which have no seed in common.
class Generator {
public:
    explicit Generator(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15u) {}
    std::uint64_t bits() {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    /// Uniform in [0, 1).
    double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    /// Uniform in [low, high).
    float uniform(float low, float high) { return low + (high - low) * static_cast<float>(bits() >> 40) * 0x1p-24f; }
    std::size_t below(std::size_t count) { return static_cast<std::size_t>(bits() % count); }
    /// Uniform in [-1, 1)^3.
    glm::dvec3 cube() {
        const double x = unit(), y = unit();
        return 2.0 * glm::dvec3(x, y, unit()) - 1.0;
    }
    glm::vec3 direction() {
        glm::dvec3 v;
        do v = cube();
        while (glm::length(v) < 0.1);
        return glm::vec3(glm::normalize(v));
    }

private:
    std::uint64_t state_;
};

} // namespace boxwood::test
