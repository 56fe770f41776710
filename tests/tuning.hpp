// SPDX-License-Identifier: MIT
// Other ways to cut the work for a while: results must not depend on them.
#pragma once

#include <cstdint>
#include <vector>

#include <doctest/doctest.h>

#include "boxwood/device.hpp"
#include "support.hpp"

namespace boxwood::test {

/// Replaces the tuning of the device under test until the end of the scope.
class TuningScope {
public:
    explicit TuningScope(const Tuning& tuning) : previous_(test_device().tuning()) { test_device().set_tuning(tuning); }
    ~TuningScope() { test_device().set_tuning(previous_); }
    TuningScope(const TuningScope&) = delete;
    TuningScope& operator=(const TuningScope&) = delete;

private:
    Tuning previous_;
};

/// The tuning of the device's class with one compute unit, with two, and with up to `most`. Units are threads, on a
/// CPU.
inline std::vector<Tuning> tunings_by_compute_units(std::uint32_t most) {
    std::vector<Tuning> tunings;
    for (const std::uint32_t units : {1u, 2u, 12u, 100u, 1000u}) {
        if (units > most) break;
        tunings.push_back(test_device().tuning());
        tunings.back().work_items = tunings.back().work_items / test_device().info().compute_units * units;
    }
    return tunings;
}

/// Checks that run() takes as much device memory for any number of compute units; the pool is empty before.
template <class Run>
void check_memory_by_compute_units(const Run& run, std::uint32_t most = 1000) {
    Device& device = test_device();
    std::vector<std::uint64_t> peaks;
    for (const Tuning& tuning : tunings_by_compute_units(small_sizes() ? 2 : most)) {
        CAPTURE(tuning.work_items);
        const TuningScope scope(tuning);
        device.trim();
        device.reset_peak();
        const std::uint64_t before = device.held_bytes();
        run();
        peaks.push_back(device.peak_bytes() - before);
        CHECK(peaks.back() == peaks.front());
    }
}

/// The device's own tuning, groups that divide nothing, groups like a GPU's with slices as short as they get, and one
/// slice for everything, where work-items behind it in its group must not begin again beyond 2^32 (the first two under
/// a checker).
inline std::vector<Tuning> tunings() {
    if (small_sizes()) return {test_device().tuning(), {3, 7, 5}};
    return {test_device().tuning(), {3, 7, 5}, {64, 4096, 1, 8}, {3, 16, 1u << 31}};
}

} // namespace boxwood::test
