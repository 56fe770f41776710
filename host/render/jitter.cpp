// SPDX-License-Identifier: MIT
#include "render/jitter.hpp"

namespace boxwood {

namespace {

/// A bijection of 64 bits (Steele et al. 2014), as in cl/render/random.h.
std::uint64_t mix_bits(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

/// The first two dimensions of Sobol's sequence, the first in the upper half.
std::uint64_t sobol_point(std::uint32_t index) {
    std::uint32_t first = 0, second = 0;
    std::uint32_t direction = 1u << 31;
    for (std::uint32_t bit = 1u << 31; index != 0; index >>= 1, bit >>= 1, direction ^= direction >> 1) {
        if ((index & 1) == 0) continue;
        first ^= bit;
        second ^= direction;
    }
    return std::uint64_t{first} << 32 | second;
}

/// In (-1, 1): the centres of 2^24 equal parts, exact.
float signed_unit(std::uint32_t bits) {
    return static_cast<float>(static_cast<std::int32_t>(2 * (bits >> 8) + 1) - (1 << 24)) * 0x1p-24f;
}

} // namespace

glm::vec2 camera_jitter(const LightOptions& options, std::uint32_t sample) {
    if (options.samples == 1) return glm::vec2(0.0f);
    constexpr std::uint64_t golden = 0x9e3779b97f4a7c15u;
    const std::uint64_t key = mix_bits(options.seed + golden);
    const std::uint64_t bits =
        options.sampler == SamplerKind::random ? mix_bits(key + (sample + 1) * golden) : sobol_point(sample) ^ key;
    return {signed_unit(static_cast<std::uint32_t>(bits >> 32)), signed_unit(static_cast<std::uint32_t>(bits))};
}

} // namespace boxwood
