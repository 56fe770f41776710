// SPDX-License-Identifier: MIT
// What every test may use: the device under test, the folder of real scenes, the seed.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <vector>

#include "boxwood/buffer.hpp"
#include "boxwood/device.hpp"

namespace boxwood::test {

/// The device under test, from --device; one for the whole run.
Device& test_device();

/// Seed of every random input, from --seed; printed at the start.
std::uint64_t test_seed();

/// BOXWOOD_SCENES, or empty when that is unset. A test that needs a real scene and lacks it says so by MESSAGE.
std::filesystem::path scenes_folder();

/// True under Oclgrind or another checker (BOXWOOD_SMALL=1): sizes must then be small.
bool small_sizes();

/// An output buffer with sentinel elements after its `size` elements; intact() is false once one was overwritten.
template <class T>
class Guarded {
public:
    static constexpr std::size_t sentinels = 64;

    Guarded(Device& device, std::size_t size) : device_(device), size_(size) {
        std::vector<unsigned char> bytes((size + sentinels) * sizeof(T), 0xa5);
        buffer_ = make_buffer<T>(device, size + sentinels, "guarded test output");
        detail::write(device, buffer_.view().handle(), bytes.data(), bytes.size());
    }
    BufferView<T> view() const { return buffer_.prefix(size_); }
    std::vector<T> values() const { return download(device_, view()); }
    bool intact() const {
        const std::vector<T> all = download(device_, buffer_);
        const auto* bytes = reinterpret_cast<const unsigned char*>(all.data());
        for (std::size_t i = size_ * sizeof(T); i < all.size() * sizeof(T); ++i)
            if (bytes[i] != 0xa5) return false;
        return true;
    }

private:
    Device& device_;
    std::size_t size_;
    mutable Buffer<T> buffer_; // const tests hand its view to what writes
};

/// The same bits in both.
template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// Small deterministic generator (splitmix64) for test inputs.
class Random {
public:
    explicit Random(std::uint64_t salt) : state_(test_seed() * 0x9e3779b97f4a7c15u + salt) {}
    std::uint64_t bits() {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    /// Uniform in [low, high).
    float uniform(float low, float high) { return low + (high - low) * static_cast<float>(bits() >> 40) * 0x1p-24f; }
    /// Uniform in [0, count), count > 0 (bias below 2^-32 for the counts used).
    std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>((bits() >> 32) * count >> 32); }

private:
    std::uint64_t state_;
};

} // namespace boxwood::test
