// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <vector>

#include "runtime/launch.hpp"
#include "support.hpp"

using namespace boxwood;
using namespace boxwood::test;

TEST_SUITE_BEGIN("runtime");

namespace {

/// Positive floats of any size, denormal ones among them.
std::vector<float> any_floats(std::uint64_t salt, std::size_t count, std::uint32_t first_bits) {
    Random random(salt);
    std::vector<float> floats(count);
    for (float& each : floats) each = std::bit_cast<float>(first_bits + random.below(0x7f7fffffu - first_bits));
    return floats;
}

struct Differences {
    std::size_t divide_sqrt = 0, others = 0;
};

/// How often the device gives other bits than IEEE 754 does. Results that are denormal count where `denormals`.
Differences differences(const std::vector<float>& a, const std::vector<float>& b, bool denormals) {
    Device& device = test_device();
    const std::size_t n = a.size();
    Guarded<float> results(device, 5 * n);
    launch(device, {"runtime/arithmetic_test.cl", "arithmetic_test"}, "arithmetic", n, upload(device, a, "a"),
           upload(device, b, "b"), results.view(), static_cast<std::uint32_t>(n));
    const std::vector<float> found = results.values();
    CHECK(results.intact());
    Differences counts;
    for (std::size_t i = 0; i < n; ++i) {
        const float exact[5] = {a[i] / b[i], std::sqrt(a[i]), a[i] + b[i], a[i] * b[i], std::fma(a[i], b[i], a[i])};
        for (std::size_t k = 0; k < 5; ++k) {
            if (!denormals && !std::isnormal(exact[k])) continue;
            if (std::bit_cast<std::uint32_t>(found[k * n + i]) != std::bit_cast<std::uint32_t>(exact[k]))
                ++(k < 2 ? counts.divide_sqrt : counts.others);
        }
    }
    return counts;
}

} // namespace

TEST_CASE("arithmetic: as IEEE 754 rounds it, what the device does not promise apart") {
    const DeviceInfo& info = test_device().info();
    const std::size_t count = small_sizes() ? 1000 : 1 << 20;
    const std::uint32_t smallest = info.denormals ? 1u : 0x00800000u;
    const Differences found =
        differences(any_floats(1, count, smallest), any_floats(2, count, smallest), info.denormals);
    CHECK(found.others == 0);
    if (info.correctly_rounded_divide_sqrt)
        CHECK(found.divide_sqrt == 0);
    else
        MESSAGE("quotients and roots that are rounded otherwise, of " << 2 * count << ": " << found.divide_sqrt);
}
