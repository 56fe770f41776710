// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

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

} // namespace boxwood
