// SPDX-License-Identifier: MIT
// Matrices at both ends of what floats hold, for the tests of what must not depend on a matrix's size.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace boxwood::test {

/// Times 2^exponent. Records of at_one() stay exact by exponents from -141 to 127.
template <std::size_t size>
std::vector<std::array<float, size>> times_power(std::vector<std::array<float, size>> records, int exponent) {
    for (std::array<float, size>& record : records)
        for (float& entry : record) entry = std::ldexp(entry, exponent);
    return records;
}

/// Each record with its largest entry in [1, 2), and all entries in units of 2^-8.
template <std::size_t size>
std::vector<std::array<float, size>> at_one(std::vector<std::array<float, size>> records) {
    for (std::array<float, size>& record : records) {
        float largest = 0.0f;
        for (const float entry : record) largest = std::max(largest, std::abs(entry));
        if (largest == 0.0f) continue;
        for (float& entry : record) entry = std::trunc(std::ldexp(entry, 8 - std::ilogb(largest))) * 0x1p-8f;
    }
    return records;
}

/// Below the normal floats, around their ends, and up to the largest ones.
inline constexpr int end_exponents[] = {-141, -140, -127, -126, -125, -101, -100, -99, 99, 100, 101, 125, 126, 127};

} // namespace boxwood::test
