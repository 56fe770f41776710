// SPDX-License-Identifier: MIT
// Other ways to cut the work for a while: results must not depend on them.
#pragma once

#include <vector>

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

/// The device's own tuning, groups that divide nothing, groups like a GPU's with slices as short as they get, and one slice for
/// everything, where work-items behind it in its group must not begin again beyond 2^32 (the first two under a checker).
inline std::vector<Tuning> tunings() {
    if (small_sizes()) return {test_device().tuning(), {3, 7, 5}};
    return {test_device().tuning(), {3, 7, 5}, {64, 4096, 1, 8}, {4, 16, 1u << 31, 16}};
}

} // namespace boxwood::test
