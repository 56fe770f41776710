// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

namespace boxwood::test {

/// |found - exact| in units of the last place of a float near `exact`.
inline double ulps(double found, double exact) {
    const int exponent = exact == 0 ? -126 : std::max(std::ilogb(exact), -126);
    return std::abs(found - exact) / std::ldexp(1.0, exponent - 23);
}

} // namespace boxwood::test
