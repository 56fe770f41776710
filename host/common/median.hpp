// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

namespace boxwood {

/// The middle value, the mean of the two in the middle of an even number; 0 for none. O(n log n).
inline double median(std::vector<double> values) {
    if (values.empty()) return 0.0;
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

} // namespace boxwood
