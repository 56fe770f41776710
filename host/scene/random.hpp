// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

namespace boxwood {

/// Scrambles 64 bits so that neighbouring inputs give unrelated outputs (the finaliser of splitmix64).
constexpr std::uint64_t scramble(std::uint64_t value) {
    value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9u;
    value = (value ^ (value >> 27)) * 0x94d049bb133111ebu;
    return value ^ (value >> 31);
}

/// A small generator (splitmix64) with the same sequence on every machine, which std:: distributions do not promise.
class Random {
public:
    constexpr explicit Random(std::uint64_t seed) : state_(seed) {}

    constexpr std::uint64_t bits() { return scramble(state_ += 0x9e3779b97f4a7c15u); }

    /// Uniform in [0, 1), a multiple of 2^-24.
    constexpr float uniform() { return static_cast<float>(bits() >> 40) * 0x1p-24f; }

    /// Uniform in [low, high).
    constexpr float uniform(float low, float high) { return low + (high - low) * uniform(); }

    /// Uniform in [0, count), for count > 0 far below 2^64.
    constexpr std::uint64_t below(std::uint64_t count) { return bits() % count; }

private:
    std::uint64_t state_;
};

/// Uniform in the cube [0, extent)^3. In separate statements, since arguments of one call are evaluated in any order.
inline glm::dvec3 random_point(Random& random, double extent) {
    const double x = random.uniform(), y = random.uniform(), z = random.uniform();
    return extent * glm::dvec3(x, y, z);
}

/// Uniform over all rotations: a unit quaternion of a point drawn from the ball of four dimensions.
inline glm::dmat3 random_rotation(Random& random) {
    while (true) {
        const double w = random.uniform(-1.0f, 1.0f), x = random.uniform(-1.0f, 1.0f);
        const double y = random.uniform(-1.0f, 1.0f), z = random.uniform(-1.0f, 1.0f);
        const double squared = w * w + x * x + y * y + z * z;
        if (squared > 1.0 || squared < 0.0625) continue;
        const double s = 2.0 / squared;
        return {{1.0 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y)},
                {s * (x * y - w * z), 1.0 - s * (x * x + z * z), s * (y * z + w * x)},
                {s * (x * z + w * y), s * (y * z - w * x), 1.0 - s * (x * x + y * y)}};
    }
}

} // namespace boxwood
