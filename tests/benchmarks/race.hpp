// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>
#include <vector>

#include "boxwood/device.hpp"
#include "common/median.hpp"

namespace boxwood::benchmarks {

/// Wall-clock milliseconds of each contender, what it enqueues included: medians of rounds in which all have a turn,
/// after one that does not count.
inline std::vector<double> race(Device& device, const std::vector<std::function<void()>>& contenders, int rounds) {
    using Clock = std::chrono::steady_clock;
    std::vector<std::vector<double>> times(contenders.size());
    for (int round = -1; round < rounds; ++round) {
        for (std::size_t i = 0; i < contenders.size(); ++i) {
            device.finish();
            const auto start = Clock::now();
            contenders[i]();
            device.finish();
            const double ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
            if (round >= 0) times[i].push_back(ms);
        }
    }
    std::vector<double> medians;
    for (const auto& each : times) medians.push_back(median(each));
    return medians;
}

} // namespace boxwood::benchmarks
